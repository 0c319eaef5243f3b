"""The critical time step of a bonded packing, 2/sqrt(lambda) with the largest eigenvalue of M^-1 K, from the elements and bonds of a
run and the matrix of Euler and Bernoulli; and whether a run kept its energy.
Usage: critical_step.py critical RUN SHARE SETTINGS
       critical_step.py bounded RUN"""
import csv
import re
import sys
from pathlib import Path

import h5py
import numpy

run = Path(sys.argv[2])


def beam(d, radius, young=10e9, poisson=0.3):
    """12 x 12, of (x1, theta1, x2, theta2)."""
    length = numpy.linalg.norm(d)
    axis = d / length
    across = numpy.eye(3) - numpy.outer(axis, axis)
    cross = numpy.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])  # cross @ v = axis x v
    area, inertia = numpy.pi * radius**2, numpy.pi * radius**4 / 4
    along = young * area / length * numpy.outer(axis, axis)
    twist = young / (2 * (1 + poisson)) * 2 * inertia / length * numpy.outer(axis, axis)
    ei = young * inertia
    # deflections w1, w2 across and slopes theta x axis: work of the cubic beam
    shift, lever = 12 * ei / length**3 * across + along, 6 * ei / length**2
    near, far = 4 * ei / length * across + twist, 2 * ei / length * across - twist
    k = numpy.zeros((12, 12))
    k[0:3, 0:3], k[0:3, 6:9], k[6:9, 0:3], k[6:9, 6:9] = shift, -shift, -shift, shift
    k[3:6, 3:6], k[3:6, 9:12], k[9:12, 3:6], k[9:12, 9:12] = near, far, far, near
    for turn in (3, 9):
        # a turn theta of an end lays the slope theta x axis = -cross @ theta on it
        k[0:3, turn:turn + 3] += -lever * cross
        k[6:9, turn:turn + 3] += lever * cross
        k[turn:turn + 3, 0:3] += (-lever * cross).T
        k[turn:turn + 3, 6:9] += (lever * cross).T
    return k


def critical_step():
    ratio = float(re.search(r'radius-ratio="([^"]+)"', (run / "resolved.xml").read_text())[1])
    with h5py.File(run / "run.h5") as record:
        frame = record["frames"][sorted(record["frames"])[-1]]
        order, ends = frame["elements/id"][()], frame["bonds/beam/ends"][()]
    with h5py.File(run / "checkpoint.h5") as saved:
        row = {number: k for k, number in enumerate(saved["elements/id"][()].tolist())}
        rows = [row[number] for number in order.tolist()]
        x, radius, mass, inertia = (saved["elements"][name][()][rows] for name in ("position", "radius", "mass", "inertia"))
    k = numpy.zeros((6 * len(x), 6 * len(x)))
    for i, j in ends:
        at = numpy.r_[6 * i:6 * i + 6, 6 * j:6 * j + 6]
        k[numpy.ix_(at, at)] += beam(x[j] - x[i], ratio * 0.5 * (radius[i] + radius[j]))
    turned = numpy.concatenate([numpy.r_[numpy.cross([0, 0, 1], at), 0, 0, 1] for at in x])  # the whole, about z
    assert numpy.abs(k @ turned).max() < 1e-9 * numpy.abs(k).max() * numpy.abs(x).max()
    m = numpy.repeat(numpy.stack([mass, inertia], axis=1), 3, axis=1).ravel()
    return 2 / numpy.sqrt(numpy.linalg.eigvalsh(k / numpy.sqrt(numpy.outer(m, m)))[-1])


def energies():
    rows = list(csv.reader(open(run / "curves/energy.csv", encoding="utf-8")))
    columns = [rows[0].index(f"{name} [J]") for name in ("stored", "kinetic")]
    return numpy.array([sum(float(row[c]) for c in columns) for row in rows[1:]])


if sys.argv[1] == "critical":
    Path(sys.argv[4]).write_text(f"step = {float(sys.argv[3]) * critical_step():.17g} s\n")
elif sys.argv[1] == "bounded":
    tenth = len(energies()) // 10
    first, last = energies()[1:tenth].max(), energies()[-tenth:].max()
    print(f"the largest energy of the last tenth is {last / first:.6f} of that of the first")
    sys.exit(not last <= 1.01 * first)
