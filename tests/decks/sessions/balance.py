"""The residual in summary.json is that of the last row of the ledger, to round-off; and small.   Usage: balance.py RUN [SAME]"""
import csv
import json
import sys
from pathlib import Path

run = Path(sys.argv[1])
energy = json.loads((run / "summary.json").read_text())["energy"]
rows = list(csv.reader(open(run / "curves/energy.csv", encoding="utf-8")))
residual = float(rows[-1][rows[0].index("residual [J]")])
assert energy["initial"] > 0, energy
assert abs(energy["residual"] - residual) < 1e-13 * energy["initial"], (energy["residual"], residual)
assert abs(residual) < 0.02 * energy["initial"], (residual, energy)
for other in sys.argv[2:]:
    assert json.loads((Path(other) / "summary.json").read_text())["energy"] == energy
    assert (Path(other) / "curves/energy.csv").read_bytes() == (run / "curves/energy.csv").read_bytes()
