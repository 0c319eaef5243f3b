"""The tip of stiffness_ratio.xml is where springs in a row put it.   Usage: stiffness_ratio.py RUN"""
import csv
import math
import sys
from pathlib import Path

rows = list(csv.reader(open(Path(sys.argv[1]) / "curves/tip.csv", encoding="utf-8")))
found = float(rows[1][rows[0].index("mean [m]")])
off = found / (1e-3 * 2e-3 * (50 / 1e6 + 49 / 1e12) / (math.pi * 0.5e-3**2)) - 1
print(f"the tip is off by {off:.2g}")
sys.exit(not abs(off) < 1e-6)
