"""Watchers looked at just these steps.   Usage: looks.py RUN [SAME]"""
import csv
import sys
from pathlib import Path

import h5py

run = Path(sys.argv[1])


def steps(name):
    return [int(row[0]) for row in list(csv.reader(open(run / f"curves/{name}.csv", encoding="utf-8")))[1:]]


assert steps("single") == [0, 100, 200, 250, 300, 700, 900], steps("single")
assert steps("both") == [0, 100, 300, 333, 600, 900], steps("both")
with h5py.File(run / "run.h5") as file:
    assert [int(step) for step in file["frames"]] == [100, 200, 900], list(file["frames"])
    frame = file["frames/000000000100"]
    assert frame.attrs["picture"] == 1
    # derived: E A / L times 0.1 mm
    assert abs(frame["bonds/beam/axial-force"][0] / (10e6 * 3.14159265 * 0.5e-3**2 / 2e-3 * 0.1e-3) - 1) < 1e-6
for other in sys.argv[2:]:
    for file in (run / "curves").iterdir():
        assert file.read_bytes() == (Path(other) / "curves" / file.name).read_bytes(), file
    with h5py.File(run / "run.h5") as one, h5py.File(Path(other) / "run.h5") as two:
        assert list(one["frames"]) == list(two["frames"])
