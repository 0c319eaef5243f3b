"""The force of two arms apart, 3 E I Delta/L^3, or how many contacts opened and where first.   Usage: thin_arms.py apart|opens RUN"""
import csv
import json
import math
import sys
from pathlib import Path

import h5py

run = Path(sys.argv[2])
rows = list(csv.reader(open(run / "curves/force.csv", encoding="utf-8")))
at = {head.split(" [")[0]: k for k, head in enumerate(rows[0])}
if sys.argv[1] == "apart":
    delta, force = (float(rows[-1][at[name]]) for name in ("displacement", "force"))
    off = force / (3 * 70e9 * math.pi * 0.4e-3**4 / 4 * delta / 20e-3**3) - 1
    print(f"P is off 3 E I Delta/L^3 by {off:.2g}")
    sys.exit(not abs(off) < 1e-3)
with h5py.File(run / "run.h5") as record:
    places = record["breaks/place"][:, 0].tolist()
print(f"{len(places)} contacts opened, at x = {[round(1e3 * x, 3) for x in places]} mm")
energy = json.loads((run / "summary.json").read_text())["energy"]
assert places == sorted(places) and places and places[0] < 0.1e-3, places
assert abs(energy["residual"]) < 0.02 * energy["work"], energy
