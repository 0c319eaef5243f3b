"""The bar as the other programs need it: read from a record of Beadwork, written as text that their decks read."""
import json
import os
import xml.etree.ElementTree as xml

import h5py
import numpy as np

BOND_TYPES = 100   # LAMMPS knows a stiffness for each type of bond: bonds are sorted by size into so many types


class Bar:
    """Elements, bonds and numbers of a run of xml-cases/speed/stored.xml whose first frame was recorded, all in SI."""

    def __init__(self, folder):
        with h5py.File(os.path.join(folder, "run.h5"), "r") as record:
            frame = record["frames"][min(record["frames"])]
            self.position = frame["elements/position"][()]
            self.radius = frame["elements/radius"][()]
            self.held = np.isin(frame["elements/id"][()], record["sets/left"][()])
            self.ends = frame["bonds/beam/ends"][()]
            self.read_deck(xml.fromstring(record["meta/resolved"][()]))
        with open(os.path.join(folder, "summary.json")) as file:
            summary = json.load(file)
        self.time_step, self.steps, self.version = summary["time_step"], summary["steps"], summary["version"]

    def read_deck(self, deck):
        beam = deck.find("bond/cohesive-beam")
        self.young, self.poisson, self.ratio = (first_number(beam.get(a)) for a in ("young", "poisson", "radius-ratio"))
        self.density = first_number(deck.find("fill/read-packing").get("density"))
        self.rate = float(deck.find("load/initial-velocity").get("gradient").split()[2])

    def corners(self, margin):
        reach = self.radius[:, None] + margin
        return (self.position - reach).min(axis=0), (self.position + reach).max(axis=0)

    def stiffness(self):
        """Of each bond, as springs at its middle: along, across, bending, twisting. Together they are the
        Euler-Bernoulli beam: E A / L, 12 E I / L^3, E I / L, G J / L."""
        first, second = self.ends.T
        length = np.linalg.norm(self.position[second] - self.position[first], axis=1)
        r = self.ratio * (self.radius[first] + self.radius[second]) / 2
        area, moment = np.pi * r**2, np.pi * r**4 / 4
        shear = self.young / (2 * (1 + self.poisson))
        return np.column_stack([self.young * area / length, 12 * self.young * moment / length**3,
                                self.young * moment / length, shear * 2 * moment / length])


def first_number(value):
    """Of a value of a resolved deck, '1600 kg/m^3'."""
    return float(value.split()[0])


def write_all(bar, folder):
    write_scene(bar, folder)
    write_tables(bar, folder)
    write_esys(bar, folder)
    write_lammps(bar, folder)


def write_scene(bar, folder):
    keys = ("time_step", "steps", "density", "rate", "young", "poisson", "ratio")
    numbers = {key: getattr(bar, key) for key in keys} | {"largest_radius": bar.radius.max()}
    with open(os.path.join(folder, "scene.json"), "w") as file:
        json.dump(numbers, file, indent=2)


def write_tables(bar, folder):
    """elements.txt: x y z radius held; bonds.txt: first second, and the four stiffnesses."""
    elements = np.column_stack([bar.position, bar.radius, bar.held])
    np.savetxt(os.path.join(folder, "elements.txt"), elements, fmt="%.17g %.17g %.17g %.17g %d")
    np.savetxt(os.path.join(folder, "bonds.txt"), np.column_stack([bar.ends, bar.stiffness()]), fmt="%d %d" + " %.17g" * 4)


def write_esys(bar, folder):
    """bar.geo: numbers from 0 on, held elements with the tag 2."""
    low, high = bar.corners(2 * bar.radius.max())
    count = len(bar.radius)
    with open(os.path.join(folder, "bar.geo"), "w") as file:
        file.write("LSMGeometry 1.2\n")
        file.write("BoundingBox " + " ".join(f"{n:.9g}" for n in (*low, *high)) + "\n")
        file.write(f"PeriodicBoundaries 0 0 0\nDimension 3D\nBeginParticles\nSimple\n{count}\n")
        rows = np.column_stack([bar.position, bar.radius, np.arange(count), 1 + bar.held])
        np.savetxt(file, rows, fmt="%.17g %.17g %.17g %.17g %d %d")
        file.write(f"EndParticles\nBeginConnect\n{len(bar.ends)}\n")
        np.savetxt(file, np.column_stack([bar.ends, np.zeros(len(bar.ends))]), fmt="%d %d %d")
        file.write("EndConnect\n")


def write_lammps(bar, folder):
    """bar.data: numbers from 1 on, held elements of type 2; bar.coefficients: the stiffness of each type of bond."""
    stiffness, kinds = bar.stiffness(), bond_types(bar)
    low, high = bar.corners(2 * bar.radius.max())
    count = len(bar.radius)
    with open(os.path.join(folder, "bar.data"), "w") as file:
        file.write(f"bar\n\n{count} atoms\n{len(kinds)} bonds\n2 atom types\n{kinds.max()} bond types\n\n")
        for axis, a, b in zip("xyz", low, high):
            file.write(f"{a:.9g} {b:.9g} {axis}lo {axis}hi\n")
        file.write("\nAtoms # bpm/sphere\n\n")
        rows = np.column_stack([1 + np.arange(count), 1 + bar.held, 2 * bar.radius, np.full(count, bar.density), bar.position])
        np.savetxt(file, rows, fmt="%d 1 %d %.17g %.17g %.17g %.17g %.17g")
        file.write("\nBonds\n\n")
        np.savetxt(file, np.column_stack([1 + np.arange(len(kinds)), kinds, 1 + bar.ends]), fmt="%d")
    with open(os.path.join(folder, "bar.coefficients"), "w") as file:
        for kind in range(1, kinds.max() + 1):
            write_bond_type(file, kind, stiffness[kinds == kind].mean(axis=0))


def bond_types(bar):
    """A type from 1 on for each bond, by the mean radius of its elements; every type has a bond."""
    size = bar.radius[bar.ends].mean(axis=1)
    share = (size - size.min()) / (size.max() - size.min())
    return 1 + np.unique(np.minimum(share * BOND_TYPES, BOND_TYPES - 1).astype(int), return_inverse=True)[1]


def write_bond_type(file, kind, stiffness):
    """Limits that are never reached (a stretch by one metre), dampers of zero."""
    along, across, bending, twisting = stiffness
    file.write(f"bond_coeff {kind} {along:.17g} {across:.17g} {twisting:.17g} {bending:.17g} "
               f"{along:.17g} 1e30 1e30 1e30 0 0 0 0\n")


def last_positions(folder):
    with h5py.File(os.path.join(folder, "run.h5"), "r") as record:
        return record["frames"][max(record["frames"])]["elements/position"][()]
