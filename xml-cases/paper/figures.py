#!/usr/bin/python3
"""Figures of the single-fibre and multi-fibre runs, mean and scatter over seeds, beside those of the paper.

Usage: figures.py SOURCE... [--rows FILE]      Needs h5py and numpy.
       figures.py --choices FOLDER             of a study of one specimen, such as single-fibre/choices.xml: a line for each run

A SOURCE is the folder of a batch (SOURCE/deck=fine-rdef-2,seed=1/...) or a table of rows that --rows has written, so that runs of
several machines or days stand in one table; of a deck and a seed that are in two, the later one counts."""
import argparse
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
        self.seed = self.seed.removeprefix("seed=")
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
        return float(numpy.interp(strain, self.strain, self.force)) if strain <= self.strain[-1] else math.nan

    def stiffness(self, low, high):
        """Slope of stress over strain between two strains [Pa]."""
        inside = (self.strain >= low) & (self.strain <= high)
        return numpy.polyfit(self.strain[inside], self.force[inside] / self.side**2, 1)[0] if inside.sum() > 2 else math.nan

    def tangent(self):
        """Before the interface is damaged anywhere, the start wave left out."""
        end = min(1e-3, numpy.nanmin([self.first("damaged share of the interface"), 1e-3]))
        return self.stiffness(0.2 * end, end)

    def secant(self):
        """Between a fifth and two fifths of the largest force: the interface has yielded."""
        top, at = self.peak()
        low, high = (float(self.strain[numpy.argmax(self.force >= share * top)]) for share in (0.2, 0.4))
        return self.stiffness(low, high)

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

    def falls_to(self, share):
        """Strain behind the peak at which the force first lies below a share of its maximum."""
        k = int(numpy.argmax(self.force))
        below = numpy.nonzero(self.force[k:] < share * self.force[k])[0]
        return self.strain[k + below[0]] if len(below) else math.nan

    def most_broken(self, share):
        """Strain at which so many of all breaks of the run have come."""
        broken = self.crack["broken"]
        return float(self.crack_strain[numpy.argmax(broken >= share * broken[-1])]) if broken[-1] > 0 else math.nan

    def middle_of_breaks(self):
        """Mean place of the resin's breaks along the load, and their deviation, over the side."""
        with h5py.File(self.folder / "run.h5") as file:
            log = file["breaks"]
            family = [n.decode() for n in log["family_names"][:]]
            if "resin" not in family:
                return math.nan, math.nan
            place = log["place"][:][log["family"][:] == family.index("resin")][:, 0] / self.side
        return (float(numpy.mean(place)), float(numpy.std(place))) if len(place) else (math.nan, math.nan)

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
            return float(numpy.mean([numpy.min(numpy.sum((middle[broken] - p) ** 2, axis=1)) <= within**2 for p in points]))

        rng = numpy.random.default_rng(1)
        return share(place[: max(1, int(early * len(place)))]), share(rng.permutation(middle[~broken])[:4000])

    def row(self):
        top, at = self.peak()
        quality = self.summary["quality"]
        middle, deviation = self.middle_of_breaks()
        early, chance = self.near_defects(0.8e-6) if "pores" in self.deck else (math.nan, math.nan)
        near = self.crack.get("share near the plane")
        return {
            "deck": self.deck, "seed": self.seed, "side [m]": self.side,
            "tangent [Pa]": self.tangent(), "centres over box [1]": self.skeleton, "secant [Pa]": self.secant(),
            "force at .005 [N]": self.force_at(0.005), "force at .01 [N]": self.force_at(0.01), "force at .015 [N]": self.force_at(0.015),
            "largest force [N]": top, "its strain [1]": at, "half of it at [1]": self.falls_to(0.5),
            "nine tenths broken at [1]": self.most_broken(0.9), "parted at [1]": self.first("parted", 0.5), "below 5 % from [1]": self.vanishes(0.05),
            "force at .08 [N]": self.force_at(0.08), "last force [N]": self.force[-1], "last strain [1]": self.strain[-1],
            "left-right [1]": self.imbalance(), "near the plane [1]": math.nan if near is None else near[-1],
            "middle of breaks [1]": middle, "deviation of breaks [1]": deviation,
            "damaged at end [1]": self.crack["damaged share of the interface"][-1],
            "open at end [1]": self.crack["open share of the interface"][-1],
            "first damage [1]": self.first("damaged share of the interface"), "first break [1]": self.first("broken"),
            "kinetic over stored [1]": quality.get("kinetic_over_stored", math.nan),
            "kinetic over stored, cracking [1]": quality.get("kinetic_over_stored_cracking", math.nan),
            "early breaks near a defect [1]": early, "by chance [1]": chance,
            "steps [1]": self.summary["steps"], "loop [s]": self.summary["loop_seconds"],
            "memory [B]": self.summary.get("peak_memory_bytes", math.nan),
        }


def rows_of(source):
    source = pathlib.Path(source)
    if source.is_file():
        with open(source, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                yield {key: value if key in ("deck", "seed") else float(value or "nan") for key, value in row.items()}
        return
    if not source.is_dir():
        print(f"figures.py: there is no '{source}', and it is left out", file=sys.stderr)
        return
    for path in sorted(source.iterdir()):
        done = path.name.startswith("deck=") and (path / "summary.json").exists()
        if done and json.loads((path / "summary.json").read_text())["status"] == "done":
            yield Run(path).row()


def spread(values, scale=1.0, digits=3):
    numbers = [v * scale for v in values if not math.isnan(v)]
    if not numbers:
        return "-"
    mean = f"{numpy.mean(numbers):.{digits}g}"
    return mean if len(numbers) < 2 else f"{mean} ± {numpy.std(numbers, ddof=1):.1g}"


def by_deck(rows):
    decks = {}
    for row in rows:
        decks.setdefault(row["deck"], []).append(row)
    return decks


def main_table(decks):
    print("| deck | seeds | tangent of the box, through the centres, secant [GPa] | F at .005, .01, .015 [mN] | F_max [mN] | stress [MPa] | at strain | half of it, 5 % from | nine tenths broken, parted at "
          "| F at .08, at the end [mN] | left-right | near mid-plane | middle of the breaks | interface damaged, open at end | first damage, first break "
          "| E_k/U before, while it cracks | min | MB |")
    print("|---|" + "---|" * 17)
    for name, rows in decks.items():
        def mean(key, scale=1.0, digits=3, of=rows):
            return spread([row.get(key, math.nan) for row in of], scale, digits)

        print("| " + " | ".join([
            name, str(len(rows)),
            mean("tangent [Pa]", 1e-9) + ", " + spread([r["tangent [Pa]"] * r["centres over box [1]"] for r in rows], 1e-9) + ", " + mean("secant [Pa]", 1e-9),
            ", ".join(mean(f"force at {e} [N]", 1e3) for e in (".005", ".01", ".015")),
            mean("largest force [N]", 1e3), spread([r["largest force [N]"] / r["side [m]"] ** 2 for r in rows], 1e-6),
            mean("its strain [1]"), mean("half of it at [1]") + ", " + mean("below 5 % from [1]"),
            mean("nine tenths broken at [1]") + ", " + mean("parted at [1]"),
            mean("force at .08 [N]", 1e3) + ", " + mean("last force [N]", 1e3), mean("left-right [1]", 100, 2) + " %", mean("near the plane [1]"),
            mean("middle of breaks [1]") + " (" + mean("deviation of breaks [1]") + ")",
            mean("damaged at end [1]") + ", " + mean("open at end [1]"), mean("first damage [1]") + ", " + mean("first break [1]"),
            mean("kinetic over stored [1]", 1, 1) + ", " + mean("kinetic over stored, cracking [1]", 1, 1),
            mean("loop [s]", 1 / 60, 2), mean("memory [B]", 1e-6, 3)]) + " |")


def pores(decks):
    print("\n| deck | peak over that without pores, same packings | early breaks near a defect | by chance |")
    print("|---|---|---|---|")
    for name, rows in decks.items():
        if "pores" not in name:
            continue
        sound = {row["seed"]: row["largest force [N]"] for row in decks.get(name.split("-pores")[0], [])}
        ratios = [row["largest force [N]"] / sound[row["seed"]] - 1 for row in rows if row["seed"] in sound]
        print(f"| {name} | {spread(ratios, 100)} % | {spread([row['early breaks near a defect [1]'] for row in rows])} "
              f"| {spread([row['by chance [1]'] for row in rows])} |")


def choices(folder):
    print("| run | modulus before the interface yields [GPa] | largest force [mN], at strain | first damage, first break | near the mid-plane | left-right | force at .02, .03 [mN] "
          "| E_k/U before, while it cracks | steps | loop [s] |")
    print("|---|" + "---|" * 9)
    for path in sorted(folder.glob("*/*/summary.json")):
        if json.loads(path.read_text())["status"] != "done":
            continue
        run = Run(path.parent)
        row = run.row()
        print(f"| {path.parent.parent.name}: {path.parent.name} | {row['tangent [Pa]'] * 1e-9:.3g} | {row['largest force [N]'] * 1e3:.4g}, {row['its strain [1]']:.3g} "
              f"| {row['first damage [1]']:.2g}, {row['first break [1]']:.2g} | {row['near the plane [1]']:.2f} | {100 * row['left-right [1]']:.2g} % "
              f"| {run.force_at(0.02) * 1e3:.4g}, {run.force_at(0.0299) * 1e3:.4g} "
              f"| {row['kinetic over stored [1]']:.1g}, {row['kinetic over stored, cracking [1]']:.1g} | {row['steps [1]']} | {row['loop [s]']:.0f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", nargs="*")
    parser.add_argument("--choices", type=pathlib.Path, help="folder of the study of one specimen")
    parser.add_argument("--rows", help="CSV file for the figures of each run")
    arguments = parser.parse_args()
    if arguments.choices:
        return choices(arguments.choices)
    if not arguments.sources:
        parser.error("a SOURCE is wanted")
    found = {}
    for source in arguments.sources:
        for row in rows_of(source):
            found[row["deck"], row["seed"]] = row
    rows = [found[key] for key in sorted(found)]
    if arguments.rows and rows:
        with open(arguments.rows, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(dict.fromkeys(key for row in rows for key in row)), restval="", lineterminator="\n")
            writer.writeheader()
            for row in rows:
                writer.writerow({key: value if isinstance(value, str) else "" if math.isnan(value) else f"{value:.6g}" for key, value in row.items()})
    decks = by_deck(rows)
    main_table(decks)
    pores(decks)
    print("\nHashin-Shtrikman bounds of the transverse modulus [GPa]; lower one with fibres that are rigid across, as rows of elements are: "
          + ", ".join(f"V_f {v}: {low / 1e9:.3g} to {high / 1e9:.3g}; {transverse_modulus(v, E_M, NU_M, 1e6 * E_F, NU_F)[0] / 1e9:.3g}"
                      for v in (0.1, 0.0955, 0.2966, 0.397) for low, high in [transverse_modulus(v, E_M, NU_M, E_F, NU_F)]))


if __name__ == "__main__":
    main()
