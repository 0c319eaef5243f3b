"""Velocity Verlet keeps kinetic + stored (1 - h^2/4) of a linear pair, h = w dt and w^2 = 2 k/m: its trend in a run of drift.xml, over
a million steps.   Usage: drift.py RUN"""
import csv
import json
import math
import sys
from pathlib import Path

import numpy

run = Path(sys.argv[1])
rows = list(csv.reader(open(run / "curves/energy.csv", encoding="utf-8")))
at = {head.split(" [")[0]: k for k, head in enumerate(rows[0])}
step, stored, kinetic = (numpy.array([float(row[at[name]]) for row in rows[1:]]) for name in ("step", "stored", "kinetic"))
k, m = 1e9 * math.pi * 0.5e-3**2 / 2e-3, 4 / 3 * math.pi * 1e-9 * 2000
h = math.sqrt(2 * k / m) * json.loads((run / "summary.json").read_text())["time_step"]
kept = kinetic + stored * (1 - h * h / 4)
trend = numpy.polyfit(step / 1e6, kept / kept[0], 1)[0]
print(f"{step[-1]:.3g} steps with w dt = {h:.3f}: the energy itself swings by {numpy.ptp(kinetic + stored) / kept[0]:.2g}, what is kept "
      f"by {numpy.ptp(kept) / kept[0]:.2g}, with a trend of {trend:.2g} in a million steps")
sys.exit(not (abs(trend) < 1e-8 and numpy.ptp(kept) / kept[0] < 1e-8))
