"""What was tried is told as it is, and what was chosen is the fastest that is near enough.   Usage: trade.py FOLDER [RUN]"""
import csv
import json
import sys
from pathlib import Path

folder = Path(sys.argv[1])
with open(folder / "trade.csv", newline="", encoding="utf-8") as file:
    rows = {row["setting"]: row for row in csv.DictReader(file)}
quantity = "force: largest force [N]"
force = {name: float(row[quantity]) for name, row in rows.items()}
error = {name: float(row["error [percent]"]) for name, row in rows.items()}
alone = {f"v={v:g} m/s" for v in (0.0125, 0.025, 0.1, 0.2, 0.4)} | {"safety=0.05", "safety=0.1", "safety=0.4", "safety=0.8"}
assert alone <= set(rows) and {"reference", "as it stands"} <= set(rows), list(rows)
assert not any(name.startswith(("E", "end", "spread")) for name in rows), list(rows)
assert error["reference"] == 0
assert any("safety=" in name and "v=" in name for name in rows), list(rows)  # together
for name in rows:
    assert abs(100 * abs(force[name] / force["reference"] - 1) - error[name]) < 1e-3 * error[name] + 1e-6, name
assert error["v=0.1 m/s"] < error["v=0.2 m/s"] < error["v=0.4 m/s"], error  # inertia
if len(sys.argv) == 2:
    result = json.loads((folder / "summary.json").read_text())["result"]
    chosen = result["within-10-percent"]["setting"]
    seconds = {name: float(row["time in the loop [s]"]) for name, row in rows.items()}
    near = [name for name in rows if error[name] <= 10]
    assert seconds[chosen] == min(seconds[name] for name in near) and error[chosen] <= 10, (chosen, result)
    assert result["scatter_percent"] == 0 and result["seeds"] == 2, result  # a lattice has no chance in it
else:
    with open(Path(sys.argv[2]) / "curves/force.csv", newline="", encoding="utf-8") as file:
        largest = max((float(row["force [N]"]) for row in csv.DictReader(file)), key=abs)
    chosen = json.loads((folder / "summary.json").read_text())["result"]["within-10-percent"]["setting"]
    assert largest == force[chosen], (largest, force[chosen])
