#!/usr/bin/python3
"""Runs a good deck and holds what it gives against what is expected.   Usage: run_good.py BEADWORK EXPECT [--measured]

    # a remark
    run with --set v=2 m/s                            more words for the command line, one option a line
    force.force at end = 300 N within 1 percent       a curve's column, at its last row
    force.force at 1 ms = 300 N within 2 N            at the row nearest to a time
    |held.force at all| < 1e-6 N                      in every row; also: largest, smallest, start
    balance closes within 1e-6 J                      the residual of every row of the ledger and of summary.json; each deck says it
    element 1 velocity.x = 2 m/s within 1e-9 percent  an element (by its id) at the end; .size: of a vector or a quaternion
    |whole momentum.x| < 1e-12 kg.m/s                 of all elements at the end; angular-momentum: about the origin, places and turns
    summary.breaks.axial = 1                          a figure of summary.json

The run is then made once more from its resolved.xml alone, from another folder, and must leave the same.

Comparisons: = |...| < >. Values are numbers or formulae such as 4/3*pi*2^3, with a unit. Without "within" = means equal. What is
to be small is bounded on both sides, so < stands behind bars only; > says that something is there, and wants a value from zero up.
--measured prints what was measured, too.
"""
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import same_run  # noqa: E402

UNITS = {"": ("1", 1), "N": ("N", 1), "kN": ("N", 1e3), "mN": ("N", 1e-3), "J": ("J", 1), "mJ": ("J", 1e-3), "m": ("m", 1), "mm": ("m", 1e-3),
         "um": ("m", 1e-6), "nm": ("m", 1e-9), "s": ("s", 1), "ms": ("s", 1e-3), "us": ("s", 1e-6), "m/s": ("m/s", 1), "mm/s": ("m/s", 1e-3),
         "1/s": ("1/s", 1), "rad": ("rad", 1), "N.m": ("N.m", 1), "Pa": ("Pa", 1), "MPa": ("Pa", 1e6), "kg": ("kg", 1), "kg.m/s": ("kg.m/s", 1), "kg.m2/s": ("kg.m2/s", 1)}


class Mistake(Exception):
    """Of the one who wrote the expectation."""


def quantity(text):
    """Value in SI and the unit's name in SI."""
    found = re.fullmatch(r"(.*?[\d.)i])(?:\s+(\S+))?", text.strip())
    if not found or not re.fullmatch(r"(?:[\d.+\-*/^() ]|\de|pi|sqrt)*", found[1]):
        raise Mistake(f"no value: {text}")
    if (found[2] or "") not in UNITS:
        raise Mistake(f"unknown unit {found[2]}")
    unit, factor = UNITS[found[2] or ""]
    number = eval(found[1].replace("^", "**"), {"__builtins__": {}, "pi": math.pi, "sqrt": math.sqrt})  # characters checked above
    return number * factor, unit


class Results:
    def __init__(self, folder):
        self.folder = folder
        self.summary = json.loads((folder / "summary.json").read_text())

    def values(self, what):
        """The values that are meant, and their unit."""
        if found := re.fullmatch(r"element (\d+) ([\w-]+)(?:\.([xyz]|size))?", what):
            return self.element(int(found[1]), found[2], found[3])
        if found := re.fullmatch(r"whole (momentum|angular-momentum)\.([xyz])", what):
            return self.whole(found[1], "xyz".index(found[2]))
        if what == "balance":
            return self.residuals(), "J"
        if what.startswith("summary."):
            value = self.summary
            for key in what.split(".")[1:]:
                value = value[key]
            return [value], "1"
        if found := re.fullmatch(r"([\w-]+)\.(.+?) at (.+)", what):
            return self.curve(*found.groups())
        raise Mistake(f"neither a curve, an element nor a figure of the summary: {what}")

    def element(self, number, field, axis):
        with h5py.File(self.folder / "checkpoint.h5") as saved, h5py.File(self.folder / "run.h5") as record:
            elements = saved["elements"]
            if field not in elements:  # derived: in the last frame
                elements = record["frames"][sorted(record["frames"])[-1]]["elements"]
            row = elements["id"][()].tolist().index(number)
            value = elements[field][row]
            component = {None: lambda: value, "size": lambda: float(numpy.linalg.norm(value))}
            return [component.get(axis, lambda: value["xyz".index(axis)])()], elements[field].attrs["unit"].decode()

    def whole(self, which, axis):
        with h5py.File(self.folder / "checkpoint.h5") as saved:
            elements = saved["elements"]
            push = elements["mass"][()][:, None] * elements["velocity"][()]
            if which == "momentum":
                return [float(push.sum(axis=0)[axis])], "kg.m/s"
            about = numpy.cross(elements["position"][()], push)
            if "spin" in elements:
                about += elements["inertia"][()][:, None] * elements["spin"][()]
            return [float(about.sum(axis=0)[axis])], "kg.m2/s"

    def curve(self, name, column, place):
        with open(self.folder / f"curves/{name}.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        heads = [re.fullmatch(r"(.*) \[(.*)\]", head).groups() for head in rows[0]]
        names = [head[0] for head in heads]
        if column not in names:
            raise Mistake(f"{name} has no column '{column}'; it has {', '.join(names)}")
        unit = heads[names.index(column)][1]
        values = [float(row[names.index(column)]) for row in rows[1:]]
        if place == "all":
            return values, unit
        chosen = {"start": lambda: values[0], "end": lambda: values[-1], "largest": lambda: max(values), "smallest": lambda: min(values)}
        if place in chosen:
            return [chosen[place]()], unit
        time, _ = quantity(place)
        times = [float(row[names.index("time")]) for row in rows[1:]]
        return [values[min(range(len(times)), key=lambda k: abs(times[k] - time))]], unit


    def residuals(self):
        """What the ledger did not find again: at the end, and in every row where the deck records it."""
        recorded = (self.folder / "curves/energy.csv").exists()
        return [*(self.curve("energy", "residual", "all")[0] if recorded else []), self.summary["energy"]["residual"]]


CLOSES = "balance closes within "


def failure(line, results, tell):
    """Why it is not met, or None."""
    found = re.fullmatch(r"(\|?)(.+?)(\|?) (=|<|>) (.+?)(?: within (.+))?", line.replace(CLOSES, "balance = 0 J within "))
    if not found:
        raise Mistake("no expectation")
    bar, what, other_bar, comparison, wanted_text, within = found.groups()
    if not bar == other_bar == ("|" if comparison == "<" else ""):
        raise Mistake("a bound from one side: write |...| < ...")
    values, unit = results.values(what)
    if isinstance(values[0], str):
        return None if values[0] == wanted_text else f'got "{values[0]}"'
    wanted, wanted_unit = quantity(wanted_text)
    if wanted_unit != unit and not what.startswith("summary."):
        raise Mistake(f"{what} is in {unit}, not in {wanted_unit}")
    if comparison == ">" and wanted < 0:
        raise Mistake("a bound from one side: write |...| < ...")
    tolerance = 0
    if within:
        tolerance = abs(wanted) * quantity(within[:-8])[0] / 100 if within.endswith(" percent") else quantity(within)[0]
    holds = {"=": lambda v: abs(v - wanted) <= tolerance, "<": lambda v: abs(v) < wanted, ">": lambda v: v > wanted}[comparison]
    if tell:
        print(f"{line}\n    measured {max(values, key=lambda v: abs(v - wanted)):.12g} {unit}")
    bad = [v for v in values if not holds(v)]
    return f"got {bad[0]:.9g} {unit}, wanted {wanted:.9g}" if bad else None


def objection(line, results, tell=False):
    try:
        reason = failure(line, results, tell)
    except (Mistake, KeyError, ValueError) as mistake:
        reason = f"this expectation cannot be read: {mistake}"
    return reason and f"{line}\n    {reason}"


# Residuals of a row and of the summary, in J, that no deck may take, and bounds that let one pass, lest the guard sleeps.
SINS = [(-1e9, 0), (1e9, 0), (0, -1e9), (0, 1e9), (math.nan, 0), (0, math.nan)]
ONE_SIDED = ["energy.residual at all < 1e-6 J", "energy.residual at all > -1e-6 J", "summary.energy.residual < 1e-6"]


def forged(folder, row, end):
    """What a run with such residuals would leave."""
    (folder / "curves").mkdir(parents=True)
    (folder / "summary.json").write_text(json.dumps({"energy": {"residual": end}}))
    (folder / "curves/energy.csv").write_text(f"time [s],residual [J]\n0,0\n1,{row}\n2,0\n")
    return Results(folder)


def asleep(lines, folder):
    """What these expectations would let pass, and should not."""
    closes = [line for line in lines if line.startswith(CLOSES)]
    if len(closes) != 1:
        return [f"how well the balance closes is said once: {CLOSES}... J"]
    taken = [f"{closes[0]}\n    takes a residual of {row} J in a row and of {end} J at the end" for number, (row, end) in enumerate(SINS)
             if not objection(closes[0], forged(folder / str(number), row, end))]
    sound = forged(folder / "sound", 0, 0)
    return taken + [f"{line}\n    bounds from one side, and nobody minds" for line in ONE_SIDED if not objection(line, sound)]


def main():
    beadwork, expect = sys.argv[1], Path(sys.argv[2])
    lines = [line.strip() for line in expect.read_text().splitlines()]
    lines = [line for line in lines if line and not line.startswith("#")]
    more = [word for line in lines if line.startswith("run with ") for word in line[9:].split(" ", 1)]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "run"
        command = [beadwork, "run", "-q", str(expect.with_suffix(".xml")), "--out", str(out), "--threads", "1", *more]
        again = [beadwork, "run", "-q", "run/resolved.xml", "--out", "again", "--threads", "1"]
        for words, place in ((command, None), (again, folder)):
            done = subprocess.run(words, cwd=place, env={**os.environ, "BEADWORK_PLUGINS": ""}, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                print(f"{' '.join(words)}: exit code {done.returncode}\n{done.stderr}")
                return 1
        wrong = [f"of the resolved deck: {each}" for each in same_run.differences(out, Path(folder) / "again")]
        wrong += asleep(lines, Path(folder) / "forged")
        results = Results(out)
        wrong += filter(None, (objection(line, results, "--measured" in sys.argv) for line in lines if not line.startswith("run with ")))
    print("\n".join(wrong) or f"{len(lines)} expectations met")
    return 1 if wrong else 0


sys.exit(main())
