"""Whether runs left the same as the first one, and where it ended.   Usage: courses.py STEP RUN OTHER..."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "support"))
import same_run  # noqa: E402

run, *others = map(Path, sys.argv[2:])
summary = json.loads((run / "summary.json").read_text(encoding="utf-8"))
assert summary["steps"] == int(sys.argv[1]), summary["steps"]
assert summary["exit_reason"] == "stage 'run' reached sensor way > 0.5 um", summary["exit_reason"]
for other in others:
    assert not same_run.differences(run, other), (other, same_run.differences(run, other))
