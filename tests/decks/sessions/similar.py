"""Whether two runs are one in units of E, rho and R, but for the step, which is found in single precision.   Usage: similar.py "R E rho" RUN
"R E rho" OTHER"""
import csv
import json
import sys
from pathlib import Path


def curves(values, folder):
    size, young, density = map(float, values.split())
    scale = {"step": 1, "time": size / (young / density)**0.5, "displacement": size, "force": young * size**2}
    found, largest = {}, {}
    for name in ("force", "energy"):
        rows = list(csv.reader(open(Path(folder) / f"curves/{name}.csv", encoding="utf-8")))
        for column, head in enumerate(rows[0]):
            what, unit = head.split(" [")
            unit_value = scale.get(what, young * size**3 if unit == "J]" else 1)
            found[name, what] = [float(row[column]) / unit_value for row in rows[1:]]
            largest[name, what] = max(map(abs, found[name, what]))
    return found, largest, json.loads((Path(folder) / "summary.json").read_text())["breaks"]


one, largest, breaks = curves(*sys.argv[1:3])
other, _, other_breaks = curves(*sys.argv[3:5])
assert breaks == other_breaks and sum(breaks.values()) > 0, (breaks, other_breaks)
worst = max(max(abs(a - b) for a, b in zip(one[key], other[key])) / (largest[key] or 1)
            for key in one if key[1] != "residual")
print(f"they differ by {worst:.2g} of the largest value of each curve at most, with {sum(breaks.values())} breaks")
sys.exit(not worst < 1e-6)
