#!/usr/bin/python3
"""Figures of the single-fibre and multi-fibre runs, mean and scatter over seeds, beside those of the paper.

Usage: figures.py FOLDER   (of a batch: FOLDER/deck=fine-rdef-2,seed=1/...)      Needs h5py and numpy."""
import collections
import csv
import json
import math
import pathlib
import sys
import xml.etree.ElementTree

import h5py
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
from hashin import transverse_modulus  # noqa: E402

E_M, E_F, NU_M, NU_F = 3.9e9, 86.9e9, 0.37, 0.23


class Run:
    """What one run has left behind; strains are 2 u over the side, stresses the reaction over the side squared."""

    def __init__(self, folder):
        self.folder = folder
        self.summary = json.loads((folder / "summary.json").read_text())
        deck = xml.etree.ElementTree.parse(folder / "resolved.xml")
        self.side = float(next(deck.iter("break-histogram")).get("to").split()[0])  # along the load
        self.deck, _, self.seed = folder.name.removeprefix("deck=").partition(",")
        inner = self.side - 2 * self.summary["packing"][-1]["mean_radius"]
        self.skeleton = self.side / inner  # modulus over the section and the length between the outer centres, over that of the box
        right, left = self.curve("force"), self.curve("force-left")
        self.strain = 2 * right["displacement"] / self.side
        self.force = right["force"]
        self.other = -left["force"]
        self.crack = self.curve("crack-plane")
        self.crack_strain = 2 * self.crack["displacement"] / self.side

    def curve(self, name):
        with open(self.folder / "curves" / f"{name}.csv", newline="") as file:
            rows = list(csv.reader(file))
        names = [word.split(" [")[0] for word in rows[0]]
        return {n: numpy.array([float(row[c]) for row in rows[1:]]) for c, n in enumerate(names)}

    def peak(self):
        k = int(numpy.argmax(self.force))
        return self.force[k], self.strain[k]

    def force_at(self, strain):
        return float(numpy.interp(strain, self.strain, self.force))

    def stiffness(self, low, high):
        """Slope of stress over strain between two strains [Pa]."""
        inside = (self.strain >= low) & (self.strain <= high)
        return numpy.polyfit(self.strain[inside], self.force[inside] / self.side**2, 1)[0] if inside.sum() > 2 else math.nan

    def tangent(self):
        """Before the interface is damaged anywhere, the start wave left out."""
        end = min(1e-3, numpy.nanmin([self.first("damaged share of the interface"), 1e-3]))
        return self.stiffness(0.2 * end, end)

    def imbalance(self):
        """Largest difference of the two faces' reactions up to the peak, over the peak; the start wave (2 % of the peak's strain) apart."""
        top, at = self.peak()
        inside = (self.strain <= at) & (self.strain >= 0.02 * at)
        return float(numpy.max(numpy.abs(self.force - self.other)[inside]) / top)

    def first(self, column, above=0.0):
        """Strain at which a column of the crack's curve first lies above a value."""
        over = numpy.nonzero(self.crack[column] > above)[0]
        return self.crack_strain[over[0]] if len(over) else math.nan

    def vanishes(self, share):
        """Strain from which on the force stays below a share of its maximum."""
        over = numpy.nonzero(self.force >= share * self.force.max())[0]
        return self.strain[over[-1]] if over[-1] < len(self.strain) - 1 else math.nan

    def near_defects(self, within, early=0.1):
        """Share of the first tenth of the breaks within a distance of a defect's middle, and of all bonds that were sound."""
        with h5py.File(self.folder / "run.h5") as file:
            log = file["breaks"]
            family = [n.decode() for n in log["family_names"][:]]
            place = log["place"][:][log["family"][:] == family.index("resin")]
            first = file["frames"][sorted(file["frames"])[0]]
            resin = first["bonds/resin"]
            middle = first["elements/position"][:][resin["ends"][:]].mean(axis=1)
            broken = resin["state"][:] == 2
        if not broken.any() or not len(place):
            return math.nan, math.nan

        def share(points):
            return numpy.mean([numpy.min(numpy.sum((middle[broken] - p) ** 2, axis=1)) <= within**2 for p in points])

        rng = numpy.random.default_rng(1)
        return share(place[: max(1, int(early * len(place)))]), share(rng.permutation(middle[~broken])[:4000])


def spread(values, scale=1.0, digits=3):
    numbers = [v * scale for v in values if not math.isnan(v)]
    if not numbers:
        return "-"
    mean = f"{numpy.mean(numbers):.{digits}g}"
    return mean if len(numbers) < 2 else f"{mean} ± {numpy.std(numbers, ddof=1):.1g}"


def hashin_shtrikman(fraction):
    """Glass in epoxy (Table 2) [Pa]."""
    return transverse_modulus(fraction, E_M, NU_M, E_F, NU_F)


def gather(folder):
    runs = collections.defaultdict(list)
    for path in sorted(pathlib.Path(folder).iterdir()):
        if not path.name.startswith("deck=") or not (path / "summary.json").exists():
            continue
        if json.loads((path / "summary.json").read_text())["status"] != "done":
            continue
        run = Run(path)
        runs[run.deck].append(run)
    return runs


def main_table(runs):
    print("| deck | seeds | tangent of the box, through the centres [GPa] | F at .005, .01, .015 [mN] | F_max [mN] | stress [MPa] | at strain | parted at | force below 5 % from "
          "| left-right | near mid-plane | interface damaged, open at end | first damage, first break | E_k/U before, while it cracks | min |")
    print("|---|" + "---|" * 14)
    for name, those in runs.items():
        each = lambda f: [f(r) for r in those]  # noqa: E731
        large = name.startswith("vf")
        near = "share near the plane"
        print("| " + " | ".join([
            name, str(len(those)),
            spread(each(lambda r: r.tangent()), 1e-9) + ", " + spread(each(lambda r: r.tangent() * r.skeleton), 1e-9),
            ", ".join(spread(each(lambda r, e=e: r.force_at(e)), 1e3) for e in (0.005, 0.01, 0.015)),
            spread(each(lambda r: r.peak()[0]), 1e3), spread(each(lambda r: r.peak()[0] / r.side**2), 1e-6),
            spread(each(lambda r: r.peak()[1])), spread(each(lambda r: r.first("parted", 0.5))), spread(each(lambda r: r.vanishes(0.05))),
            spread(each(lambda r: r.imbalance()), 100, 2) + " %",
            "-" if large else spread(each(lambda r: r.crack[near][-1])),
            spread(each(lambda r: r.crack["damaged share of the interface"][-1])) + ", "
            + spread(each(lambda r: r.crack["open share of the interface"][-1])),
            spread(each(lambda r: r.first("damaged share of the interface"))) + ", " + spread(each(lambda r: r.first("broken"))),
            spread(each(lambda r: r.summary["quality"].get("kinetic_over_stored", math.nan)), 1, 1) + ", "
            + spread(each(lambda r: r.summary["quality"].get("kinetic_over_stored_cracking", math.nan)), 1, 1),
            spread(each(lambda r: r.summary["loop_seconds"] / 60), 1, 2)]) + " |")


def pores(runs):
    print("\n| deck | peak over that without pores, same packings | early breaks near a defect | by chance |")
    print("|---|---|---|---|")
    for name, those in runs.items():
        if "pores" not in name:
            continue
        sound = {r.seed: r for r in runs.get(name.split("-pores")[0], [])}
        ratios = [r.peak()[0] / sound[r.seed].peak()[0] - 1 for r in those if r.seed in sound]
        found = [r.near_defects(0.8e-6) for r in those]
        print(f"| {name} | {spread(ratios, 100)} % | {spread([f[0] for f in found])} | {spread([f[1] for f in found])} |")


if __name__ == "__main__":
    all_runs = gather(sys.argv[1])
    main_table(all_runs)
    pores(all_runs)
    print("\nHashin-Shtrikman bounds of the transverse modulus [GPa]; lower one with fibres that are rigid across, as rows of elements are: "
          + ", ".join(f"V_f {v}: {low / 1e9:.3g} to {high / 1e9:.3g}; {transverse_modulus(v, E_M, NU_M, 1e6 * E_F, NU_F)[0] / 1e9:.3g}"
                      for v in (0.1, 0.0955, 0.2966, 0.397) for low, high in [hashin_shtrikman(v)]))
