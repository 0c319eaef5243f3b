"""Each run holds the same three elements, and tells of its packing.   Usage: packing_tables.py RUN ..."""
import json
import math
import sys
from pathlib import Path

import h5py
import numpy as np

for run in map(Path, sys.argv[1:]):
    with h5py.File(run / "run.h5") as file:
        elements = file["frames/000000000000/elements"]
        assert np.allclose(np.sort(elements["position"][:, 0]), [0, 2e-3, 4e-3], rtol=1e-12, atol=0), elements["position"][()]
        assert np.allclose(elements["mass"][()], 1000 * 4 / 3 * math.pi * 1e-9, rtol=1e-12), elements["mass"][()]
    (packing,) = json.loads((run / "summary.json").read_text())["packing"]
    assert (packing["elements"], packing["step"], packing["set"]) == (3, "read-packing", "all"), packing
    assert abs(packing["coordination"] - 4 / 3) < 1e-4, packing  # derived: two contacts, three elements
    assert abs(packing["density"] - math.pi / 6) < 1e-4, packing  # spheres in the box around them
    assert "seed" not in packing and "kolmogorov_smirnov_distance" not in packing, packing
