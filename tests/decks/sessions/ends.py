"""Watchers of ends.xml looked at just these steps.   Usage: ends.py RUN STEPS [SAME]"""
import csv
import sys
from pathlib import Path

import h5py

run, end = Path(sys.argv[1]), int(sys.argv[2])


def steps(name):
    return [int(row[0]) for row in list(csv.reader(open(run / f"curves/{name}.csv", encoding="utf-8")))[1:]]


assert steps("seldom") == [0, 34, *range(40, end, 40), end], steps("seldom")
assert steps("last") == [34, end], steps("last")
assert steps("some") == [10, 34, 44, *([134] if end > 134 else []), end], steps("some")
with h5py.File(run / "run.h5") as file:
    assert [int(step) for step in file["frames"]] == [34, end], list(file["frames"])
    for step, frame in file["frames"].items():  # E A / L times the displacement: asked for at a step that nobody knew to be the last
        force = 10e6 * 3.14159265 * 0.5e-3**2 / 2e-3 * int(step) * 1e-6
        assert abs(frame["bonds/beam/axial-force"][0] / force - 1) < 1e-6, (step, frame["bonds/beam/axial-force"][0], force)
for other in sys.argv[3:]:
    for file in (run / "curves").iterdir():
        assert file.read_bytes() == (Path(other) / "curves" / file.name).read_bytes(), file
    with h5py.File(run / "run.h5") as one, h5py.File(Path(other) / "run.h5") as two:
        assert list(one["frames"]) == list(two["frames"])
