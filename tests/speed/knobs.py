#!/usr/bin/python3
"""What a knob costs and what it buys: wall time against error, for the decks of xml-cases. It reports; it judges nothing.

Usage: tests/speed/knobs.py BEADWORK [case ...]      cases: bar, cantilever, dcb, notched-bar; all of them if none is named

A knob is an attribute, 'tag.attribute', which is written into a copy of the deck, or a parameter of the deck. Errors are those against a run that is
converged: slower, with a smaller time step, or judged at each step. Each run has one thread; beside it, on another processor, runs the deck as it is, so
that 'time' is a ratio of seconds in the loop under equal conditions, and what else the machine does counts for both."""
import concurrent.futures
import csv
import itertools
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import h5py
import numpy as np

CASES = pathlib.Path(__file__).resolve().parents[2] / "xml-cases"
STEP = ("safety", [{"verlet.safety": s} for s in (.1, .3, .5, .8, .9, .95, .99, 1)])
BETA = ("beta", [{"verlet.beta": b} for b in (1, .99, .9, .7, .5)])
MIXED = ("precision", [{"verlet.precision": "mixed"}])


def damping(*values):
    return ("local damping", [{"verlet.local-damping": d} for d in values])


def dashpots(*values):
    return ("bond damping instead of local", [{"verlet.local-damping": 0, "verlet.bond-damping": d} for d in values])


def faster(factors, change):
    return ("loading, times faster", [{"": f, **change(f)} for f in factors])      # what stands under "" is shown, not written


def bar(run, converged):
    """Displacements at 0.1 ms, about half of a swing; energy that came from nowhere, over the initial energy."""
    def displacements(r):
        with h5py.File(r.out / "checkpoint.h5") as end, h5py.File(r.out / "run.h5") as start:
            to = 1e-4 - end["meta"].attrs["time"]                                  # the last step may miss the moment by half of its length
            return (end["elements/position"][:] + to * end["elements/velocity"][:])[np.argsort(end["elements/id"][:])] - \
                start["frames/000000000000/elements/position"][:][np.argsort(start["frames/000000000000/elements/id"][:])]
    ours, right = displacements(run), displacements(converged)
    return {"displacements off by": np.linalg.norm(ours - right) / np.linalg.norm(right),
            "residual / initial energy": abs(run.energy["residual"]) / run.energy["initial"]}


def cantilever(run, converged):
    """Force of the driven tip at the end, against the formula and against the converged run."""
    E, I, L = 70e9, np.pi * 0.4e-3**4 / 4, 20e-3
    last = {n: c[-1] for n, c in run.curve("force").items()}
    return {"P off 3EIw/L^3 by": abs(last["force"] / (3 * E * I / L**3 * last["displacement"]) - 1),
            "P off converged by": abs(last["force"] / converged.curve("force")["force"][-1] - 1),
            "kinetic / stored": run.energy["kinetic"] / run.energy["stored: beam"],
            "residual / work": abs(run.energy["residual"] / run.energy["work"])}


def dcb(run, converged):
    """P(Delta) at the points of the run, relative to the peak; the crack at the end."""
    def difference(curve, column):
        ours, right = run.curve(curve), converged.curve(curve)
        return ours[column] - np.interp(ours["displacement"], right["displacement"], right[column])
    peak = converged.curve("force")["force"].max()
    return {"P(Delta), rms / peak": np.sqrt(np.mean(difference("force", "force")**2)) / peak,
            "peak": run.curve("force")["force"].max() / peak - 1,
            "open crack at the end": difference("crack", "crack length open")[-1],
            "damaged": difference("crack", "crack length damaged")[-1],
            "kinetic / work": run.energy["kinetic"] / run.energy["work"],
            "residual / work": abs(run.energy["residual"] / run.energy["work"])}


def notched_bar(run, converged):
    """Up to the peak; behind it which bond breaks next hangs on the last digit."""
    ours, right = run.curve("force"), converged.curve("force")
    peak = right["force"].max()
    before = ours["displacement"] < right["displacement"][right["force"].argmax()]
    difference = (ours["force"] - np.interp(ours["displacement"], right["displacement"], right["force"])) / peak
    return {"peak": ours["force"].max() / peak - 1,
            "F(u) up to the peak, rms / peak": np.sqrt(np.mean(difference[before]**2)),
            "released energy": run.released() / converged.released() - 1,
            "breaks": sum(run.summary["breaks"].values()),
            "residual / work": abs(run.energy["residual"] / run.energy["work"])}


# repeats: the shown time is the median of as many pairs
STUDIES = {
    "bar": dict(deck="speed/bar.xml", sets={"count": 3000, "size": 0.4217, "steps": "0.1 ms"}, repeats=3, errors=bar, converged={"verlet.safety": .05},
                knobs=[STEP, BETA, damping(.02, .1), ("ledger every", [{"energy-ledger.every": n} for n in (1, 10, 100, 1000)]), MIXED]),
    "cantilever": dict(deck="cantilever/quick.xml", sets={}, repeats=3, errors=cantilever,
                       converged={"verlet.safety": .3, "pull.table": "0 s 0 m/s, 4 ms 0.0025 m/s, 12 ms 0 m/s", "verlet.until": "48 ms"},
                       knobs=[STEP, BETA, damping(0, .1, .3, .6, .8), dashpots(.02, .1, .3, .7), faster((1, 2, 4, 8, 16), lambda f: {
                           "pull.table": f"0 s 0 m/s, {.5 / f} ms {.02 * f} m/s, {1.5 / f} ms 0 m/s", "verlet.until": f"{6 / f} ms"}),
                           ("curves and ledger every", [{"force-curve.every": n, "energy-ledger.every": n} for n in (1, 10, 100, 1000)]), MIXED]),
    "dcb": dict(deck="dcb/quick.xml", sets={"count": 2000}, repeats=1, errors=dcb, converged={"v": "0.1 m/s", "verlet.safety": .45},
                knobs=[faster((1, 2, 4, 8, 16), lambda f: {"v": f"{.4 * f} m/s", "force-curve.every": max(10, 200 // f), "crack-length.every": max(50, 1000 // f)}),
                       STEP, damping(0, .1, .3, .6), dashpots(.02, .1), BETA, MIXED, ("seed", [{"seed": 2}, {"seed": 3}])]),
    "notched-bar": dict(deck="notched-bar/quick.xml", sets={}, repeats=1, errors=notched_bar, converged={"v": "0.005 m/s", "verlet.safety": .2},
                        knobs=[("criterion every", [{"bond-stress.every": n} for n in (1, 2, 5, 10, 50, 100)]), ("safety", [{"verlet.safety": s} for s in (.3, .5, .9)]),
                               damping(0, .3), faster((2, 4, 8), lambda f: {"v": f"{.01 * f} m/s"}), ("beta", [{"beta": b} for b in (.99, .9, .7, .5)]), MIXED,
                               ("strength, last digits", [{"strength": f"{30 + e} MPa"} for e in (1e-13, 1e-12, 1e-11)]), ("seed", [{"scene.seed": 2}, {"scene.seed": 3}])]),
}


class Run:
    """What one run has left behind."""

    def __init__(self, out):
        self.out = out
        self.summary = json.loads((out / "summary.json").read_text())
        self.energy, self.seconds = self.summary["energy"], self.summary["loop_seconds"]

    def curve(self, name):
        with open(self.out / "curves" / f"{name}.csv", newline="") as file:
            head, *rows = csv.reader(file)
        return {n.split(" [")[0]: c for n, c in zip(head, np.array(rows, float).T)}

    def released(self):
        with h5py.File(self.out / "run.h5") as file:
            return file["breaks/energy"][:].sum()


def run(study, changes, number=itertools.count()):
    """Runs a copy of the deck with the changes; None if the program refuses or stops it."""
    folder = scratch / f"{next(number)}"
    deck = folder / study["deck"]
    shutil.copytree((CASES / study["deck"]).parent, deck.parent)
    tree, sets = xml.parse(deck), dict(study["sets"])
    for name, value in changes.items():
        tag, _, attribute = name.rpartition(".")
        if tag:
            for element in [tree.getroot()] if tag == "scene" else tree.getroot().iter(tag):
                element.set(attribute, str(value))
        elif name:
            sets[name] = value
    tree.write(deck)
    words = [word for name, value in sets.items() for word in ("--set", f"{name}={value}")]
    done = subprocess.run([beadwork, "run", deck, "--out", folder / "out", "--threads", "1", "--quiet", *words], capture_output=True, text=True)
    if done.returncode:
        print(f"{changes}: {done.stderr.strip()}", file=sys.stderr)
    return None if done.returncode else Run(folder / "out")


def table(study):
    with concurrent.futures.ThreadPoolExecutor(2) as two:
        def beside(changes):
            return [f.result() for f in (two.submit(run, study, changes), two.submit(run, study, {}))]
        converged, plain = beside(study["converged"])
        titles = list(study["errors"](plain, converged))
        print("| knob | | time | steps |", *(f" {t} |" for t in titles), sep="")
        print("|---|---|---|---|", *("---|" for _ in titles), sep="")
        row("as it is", "", 1, 1, study["errors"](plain, converged))
        row("converged", "", converged.seconds / plain.seconds, converged.summary["steps"] / plain.summary["steps"], study["errors"](converged, converged))
        for knob, variants in study["knobs"]:
            for changes in variants:
                pairs = [beside(changes) for _ in range(study["repeats"])]
                shown = changes.get("", list(changes.values())[-1])
                if any(ours is None for ours, _ in pairs):
                    print(f"| {knob} | {shown} | stopped or refused |", flush=True)
                    continue
                ours, plain = pairs[0]
                row(knob, shown, statistics.median(a.seconds / b.seconds for a, b in pairs), ours.summary["steps"] / plain.summary["steps"], study["errors"](ours, converged))
                for folder in scratch.iterdir():                                   # what is measured is not kept
                    if folder != converged.out.parent:
                        shutil.rmtree(folder)


def row(knob, shown, time, steps, errors):
    print(f"| {knob} | {shown} | {time:.2f} | {steps:.2f} |", *(f" {e:.3g} |" if isinstance(e, float) else f" {e} |" for e in errors.values()), sep="", flush=True)


if __name__ == "__main__":
    if len(sys.argv) < 2 or not set(sys.argv[2:]) <= set(STUDIES):
        sys.exit(__doc__)
    beadwork = shutil.which(sys.argv[1]) or sys.exit(f"there is no program {sys.argv[1]}")
    for case in sys.argv[2:] or STUDIES:
        print(f"\n{case}: {STUDIES[case]['deck']}", *(f"--set {n}={v!r}" for n, v in STUDIES[case]["sets"].items()), "\n")
        with tempfile.TemporaryDirectory() as name:
            scratch = pathlib.Path(name)
            table(STUDIES[case])
