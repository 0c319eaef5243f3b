"""The run went on with a new record, and its summary says so.   Usage: damaged.py RUN"""
import json
import sys
from pathlib import Path

import h5py

run = Path(sys.argv[1])
summary = json.loads((run / "summary.json").read_text())
assert summary["status"] == "done" and summary["steps"] == 300, summary
assert "run.h5 is damaged" in summary["notes"][0], summary["notes"]
with h5py.File(run / "run.h5") as file:
    assert list(file["frames"]) == ["000000000300"], list(file["frames"])
