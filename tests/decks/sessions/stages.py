"""Questions to the curve of stages.xml.   Usage: stages.py RUN goes-on | ends-at STEP"""
import csv
import sys
from pathlib import Path

rows = list(csv.reader((Path(sys.argv[1]) / "curves/force.csv").open()))[1:]
step, time, moved = [int(r[0]) for r in rows], [float(r[1]) for r in rows], [float(r[2]) for r in rows]
if sys.argv[2] == "goes-on":  # the ramp has passed long before the second stage: 1 mm/s all the way from there
    late = [k for k in range(1, len(rows)) if time[k] > 30e-6 and step[k] != step[k - 1]]
    assert max(step) == 800 and len(late) > 70, (max(step), len(late))
    speed = [(moved[k] - moved[k - 1]) / (time[k] - time[k - 1]) for k in late]
    assert all(abs(v / 1e-3 - 1) < 1e-6 for v in speed), (min(speed), max(speed))
else:
    assert step[-1] == int(sys.argv[3]), step[-1]
