"""Two packings of 300 elements beside a single one: whole, apart, and unlike one another.   Usage: packings.py RUN"""
import json
import math
import sys
from pathlib import Path

import h5py
import numpy as np

run = Path(sys.argv[1])
summary = json.loads((run / "summary.json").read_text())
assert summary["elements"] == 601, summary["elements"]
assert [p["elements"] for p in summary["packing"]] == [300] * 4, summary["packing"]

with h5py.File(run / "run.h5") as file:
    elements = file["frames/000000000000/elements"]
    x, radius, mass = (elements[name][()] for name in ("position", "radius", "mass"))
    members = file["sets/all"][()]
assert sorted(members) == list(range(601)), "each element is in the set once"

second = x[:, 0] > 1.5e-3
first = (x[:, 0] > -0.5e-3) & ~second
assert (first.sum(), second.sum()) == (300, 300)
density = mass / (4 / 3 * math.pi * radius**3)
assert np.allclose(density, np.where(second, 2000, 1000), rtol=1e-12)


def distances(a, b):
    return np.linalg.norm(a[:, None] - b[None], axis=2)


overlap = 1 - (distances(x, x) + np.diag(np.full(len(x), 1.0))) / (radius[:, None] + radius[None])
assert overlap.max() < 2e-6, overlap.max()
to_its_twin = distances(x[first] + (2e-3, 0, 0), x[second]).min(axis=1)
assert np.median(to_its_twin) > 0.1 * radius[second].mean(), "the second packing is a copy of the first"
