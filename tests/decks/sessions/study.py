"""A study has run what it says, in the order in which it needs it, and gives means over seeds.   Usage: study.py FOLDER"""
import csv
import json
import statistics
import sys
from pathlib import Path

folder = Path(sys.argv[1])
with open(folder / "batch.csv", newline="", encoding="utf-8") as file:
    runs = {row["run"]: row for row in csv.DictReader(file)}
assert len(runs) == 9 and all(row["status"] == "done" for row in runs.values()), {k: v["status"] for k, v in runs.items()}
for seed in "123":
    packing = json.loads((folder / f"packings/seed={seed}/summary.json").read_text())
    assert 1e6 < packing["peak_memory_bytes"] < 1e9, packing["peak_memory_bytes"]
    for young in ("1-GPa", "2-GPa"):
        name = f"beams/young={young},seed={seed}"
        assert runs[name]["young"] == young.replace("-", " ") and runs[name]["seed"] == seed
        assert runs[name]["elements"] == str(packing["elements"])
        assert json.loads((folder / name / "summary.json").read_text())["steps"] == 20
with open(folder / "means.csv", newline="", encoding="utf-8") as file:
    means = list(csv.DictReader(file))
column = "force: largest force [N]"
beams = {row["young"]: row for row in means if row["sweep"] == "beams"}
assert set(beams) == {"1 GPa", "2 GPa"} and all(row["runs"] == "3" for row in means), means
for young, row in beams.items():
    each = [float(run[column]) for run in runs.values() if run["young"] == young]
    assert abs(float(row["mean of " + column]) / statistics.mean(each) - 1) < 1e-12
    assert abs(float(row["scatter of " + column]) / statistics.stdev(each) - 1) < 1e-9
