"""How many bonds broke, all in how many steps, and how well the balance closes; whether another run is the same to the bit.
Usage: all_break.py BONDS RUN [SAME]"""
import json
import sys
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
import same_run  # noqa: E402

wanted, run = int(sys.argv[1]), Path(sys.argv[2])
summary = json.loads((run / "summary.json").read_text())
with h5py.File(run / "run.h5") as record:
    steps = set(record["breaks/step"][()].tolist()) if "breaks" in record else set()
    broken = len(record["breaks/step"]) if "breaks" in record else 0
energy = summary["energy"]
off = abs(energy["residual"]) / energy["initial"]
print(f"{broken} bonds broke in steps {sorted(steps)}; residual over the energy {off:.2g}")
assert broken == wanted and len(steps) == (1 if wanted else 0)
assert off < 1e-3
for other in sys.argv[3:]:
    assert not same_run.differences(run, Path(other)), same_run.differences(run, Path(other))
