"""Both runs hold the same two elements of 1 mm, which touch.   Usage: stored_packing.py RUN SAME"""
import sys
from pathlib import Path

import h5py
import numpy as np

for run in sys.argv[1:]:
    with h5py.File(Path(run) / "run.h5") as file:
        elements = file["frames/000000000000/elements"]
        assert np.array_equal(np.sort(elements["position"][:, 0]), [0, 2e-3]), elements["position"][()]
        assert np.array_equal(elements["radius"][()], [1e-3, 1e-3]), elements["radius"][()]
