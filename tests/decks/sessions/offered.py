"""Fields of single bonds in the frames of offered.xml; and those of other runs are the same.   Usage: offered.py RUN [SAME]"""
import json
import math
import sys
from pathlib import Path

import h5py

run = Path(sys.argv[1])
with h5py.File(run / "run.h5") as file:
    broke = {int(bond): int(step) for bond, step in zip(file["breaks/bond"], file["breaks/step"])}
    assert list(broke) == [0] and 300 < broke[0] < 700, broke
    assert len(file["frames"]) == 11, list(file["frames"])
    for name, frame in file["frames"].items():
        x = frame["elements/position"][:, 0]
        for family, (left, strength) in {"weak": (0, 20e6), "strong": (1, 200e6)}.items():
            bond = frame[f"bonds/{family}"]
            holds = bond["state"][0] < 2
            assert holds == (family == "strong" or int(name) < broke[0]), (name, family)
            # E A / L times the stretch; the larger one of two criteria
            force = 10e9 * math.pi * 1e-3**2 / 2e-3 * (x[left + 1] - x[left] - 2e-3) if holds else 0
            assert abs(bond["axial-force"][0] - force) <= 1e-6 * abs(force) + 1e-9, (name, family, bond["axial-force"][0], force)
            use = max(0, force / (math.pi * 1e-3**2 * strength))
            assert abs(bond["utilisation"][0] - use) <= 1e-6 * use + 1e-15, (name, family, bond["utilisation"][0], use)
            assert (bond["section-radius"][0] > 0) == holds, (name, family)
uses = json.loads((run / "summary.json").read_text())["utilisation"]
assert list(uses) == ["fail.bond-stress", "fail.bond-stress.2", "fail.bond-stress.3"], uses
weak, strong, third = uses.values()
assert weak["of"] == "weak" and 1 <= weak["largest"] < 1.1 and weak["bond"] == 0 and weak["step"] == broke[0] and weak["elements"] == [0, 1], weak
assert 0.05 < strong["largest"] < 0.2 and strong["bond"] == 1 and strong["elements"] == [1, 2] and strong["step"] % 7 == 0, strong
assert abs(strong["place"][0] - 3e-3) < 1e-4 and third["step"] % 11 == 0 and third["largest"] < 0.5 * strong["largest"] + 0.01, (strong, third)
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
import same_run  # noqa: E402

for other in sys.argv[2:]:
    assert not same_run.differences(run, Path(other)), same_run.differences(run, Path(other))
    assert json.loads((Path(other) / "summary.json").read_text())["utilisation"] == uses
