"""The failed run left a summary that says why, and a checkpoint; or the resumed run is as one that never failed.   Usage: full_disk.py RUN [SAME]"""
import json
import sys
from pathlib import Path

import h5py

run = Path(sys.argv[1])
summary = json.loads((run / "summary.json").read_text())
if len(sys.argv) == 2:
    assert summary["status"] == "failed", summary["status"]
    assert "the disk is full" in summary["exit_reason"], summary["exit_reason"]
    assert f"the newest checkpoint is of step {summary['steps']}," in summary["exit_reason"], summary["exit_reason"]
    with h5py.File(run / "checkpoint.h5") as file:
        assert file["meta"].attrs["step"] == summary["steps"] > 50, summary["steps"]
else:
    other = Path(sys.argv[2])
    assert summary["status"] == "done", summary["status"]
    assert (run / "curves/energy.csv").read_bytes() == (other / "curves/energy.csv").read_bytes()
    with h5py.File(run / "run.h5") as one, h5py.File(other / "run.h5") as two:
        assert list(one["frames"]) == list(two["frames"])
