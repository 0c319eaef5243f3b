"""Both materials have their elements and densities, and the set across both is whole.   Usage: packing_sets.py RUN"""
import json
import math
import sys
from pathlib import Path

import h5py
import numpy as np

run = Path(sys.argv[1])
with h5py.File(run / "run.h5") as file:
    elements = file["frames/000000000000/elements"]
    x, mass, ids = (elements[name][()] for name in ("position", "mass", "id"))
    sets = {name: np.isin(ids, file[f"sets/{name}"][()]) for name in file["sets"]}
density = mass / (4 / 3 * math.pi * 1e-9)
assert np.array_equal(sets["glass"], x[:, 1] < 1e-3), sets
assert np.array_equal(sets["matrix"], x[:, 1] > 1e-3), sets
assert np.array_equal(sets["end"], x[:, 0] > 3e-3), sets
assert np.allclose(density, np.where(sets["glass"], 2500, 1200), rtol=1e-12), density
assert [p["elements"] for p in json.loads((run / "summary.json").read_text())["packing"]] == [3, 6]
