#!/usr/bin/python3
"""The quick deck of a case, shortened to some hundred steps, past the first damage or break where it has any.
Usage: run_cases.py BEADWORK DECK QUESTION

same_bits   one thread, two threads, a run split by a restart, and narrower instruction sets: equal bits in every
            checkpoint, curve and frame, which have every field that the deck's plugins offer; a look at each step: equal bits
            in the checkpoint
mixed       as same_bits, with the forces of beams in single precision
killed      kill -9 in the middle: run.h5 opens, and the checkpoint goes on to the same bits
resolved    resolved.xml alone, run from another folder: equal bits in every curve, frame and checkpoint
terminated  SIGTERM: exit code 5, a checkpoint, and --resume goes on to the same bits
"""
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "support"))
import same_run  # noqa: E402

# Steps to run, and parameters by which those steps reach the damage that the case is about. A case that is not listed
# runs STEPS steps of its deck as it is.
STEPS = 600
HURRY = {
    "dcb": (600, ["v=200 m/s", "a0=1 mm", "strength=0.1 MPa", "G=1e-4 N/mm", "count=1500"]),
    "glued-block": (600, ["v=20 m/s", "count=800"]),
    "notched-bar": (600, ["v=40 m/s", "strength=30 MPa", "count=600"]),
    "notched-bar/static": (40, ["strength=30 MPa", "count=600", "increment=2 um"]),
    "curved-beam": (6, []),
    "roll-up": (16, []),
    "alfano-crisfield": (150, ["increment=20 um"]),
    "enf": (150, []),
    "single-fibre": (600, ["v=5 m/s", "rise=0.01 us", "count=700"]),
    "multi-fibre": (600, ["v=10 m/s", "rise=0.02 us", "count=800"]),
    "notched-bar/rdef": (600, ["v=40 m/s", "strength=2 MPa", "count=600"]),
}
WALL_CLOCK = {"loop-seconds", "wall-seconds"}  # told, not computed


class Case:
    def __init__(self, beadwork, deck, folder):
        self.beadwork, self.folder = beadwork, folder / deck.parent.name
        self.steps, self.settings = HURRY.get(f"{deck.parent.name}/{deck.stem}", HURRY.get(deck.parent.name, (STEPS, [])))
        self.every = max(1, self.steps // 20)
        self.folder.mkdir()
        for file in [*deck.parent.glob("*.xml"), *deck.parent.glob("*.csv")]:
            shutil.copy(file, self.folder)
        if "../calibration/" in deck.read_text():
            shutil.copytree(deck.parent.parent / "calibration", folder / "calibration")
        self.deck = self.folder / deck.name
        self.deck.write_text(self.deck.read_text().replace("</scene>", '<watch><snapshot fields="all" every="1"/></watch></scene>'))
        self.drop_parameters_of_until()

    def drop_parameters_of_until(self):
        """Where only the end that is replaced needs a parameter, the deck is refused: nothing in it may be unused."""
        for _ in range(10):
            check = [self.beadwork, "check", str(self.deck), *self.overrides()]
            self.command("none", 1)
            said = subprocess.run(check, capture_output=True, text=True, check=False).stderr
            unused = re.findall(r"^(.*?):(\d+):\d+: error: parameter '\S+' is used nowhere", said, re.MULTILINE)
            for file, line in unused:
                lines = Path(file).read_text().splitlines(keepends=True)
                lines[int(line) - 1] = "\n"
                Path(file).write_text("".join(lines))
            if not unused:
                return

    def overrides(self):
        return [word for setting in self.settings for word in ("--set", setting)]

    def command(self, out, steps, threads=1, *more):
        """The deck that ends after so many steps; looks often enough to have rows and frames."""
        for file in self.folder.glob("*.xml"):  # those that the deck includes too
            text = re.sub(r' until="[^"]*"', f' until="{steps}"', file.read_text())
            # of watchers: when a criterion judges is physics
            file.write_text(re.sub(r' every="(?!\$\{judged-every\})[^"]*"', f' every="{self.every}"', text))
        return [self.beadwork, "run", "-q", str(self.deck), "--out", str(self.folder / out), "--threads", str(threads),
                *self.overrides(), *more]

    def run(self, *arguments):
        done = subprocess.run(self.command(*arguments), capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"FAILED: {' '.join(done.args)}: exit code {done.returncode}\n{done.stderr}")

    def compare(self, one, other, alike=True):
        """Every difference of two runs, to the bit; of their states only, where they were not looked at alike."""
        differences = []
        with h5py.File(self.folder / one / "checkpoint.h5") as a, h5py.File(self.folder / other / "checkpoint.h5") as b:
            names = [set(), set()]
            for file, found in zip((a, b), names):
                file.visititems(lambda name, item, found=found: found.add(name) if isinstance(item, h5py.Dataset) else None)
            differences += [f"only in one checkpoint: {name}" for name in names[0] ^ names[1]]
            for name in sorted(names[0] & names[1]):
                if name.split("/")[-1] in WALL_CLOCK or name == "meta/resolved" or name.startswith("meta/value"):
                    continue
                if not alike and name == "lists/watchers/last-look":  # at which step each watcher looked last
                    continue
                left, right = a[name][()], b[name][()]
                if numpy.asarray(left).tobytes() != numpy.asarray(right).tobytes():
                    differences.append(f"{name}: {count_of(left, right)}")
            for name in ("time", "step", "stage", "time-step", "stage-start", "stage-step"):
                if a["meta"].attrs[name] != b["meta"].attrs[name]:
                    differences.append(f"{name}: {a['meta'].attrs[name]} and {b['meta'].attrs[name]}")
            damaged = any((family["state"][()] > 0).any() for family in a["bonds"].values()) if "bonds" in a else False
        for curve in sorted((self.folder / one / "curves").glob("*.csv")) if alike else []:
            if curve.read_bytes() != (self.folder / other / "curves" / curve.name).read_bytes():
                differences.append(f"curves/{curve.name}")
        with h5py.File(self.folder / one / "run.h5") as a, h5py.File(self.folder / other / "run.h5") as b:
            frames = [list(file.get("frames", {})) for file in (a, b)]
            if alike and frames[0] != frames[1]:
                differences.append(f"frames {frames[0][:30]} and {frames[1][:30]}")
        for group in ("frames", "breaks") if alike else ():
            differences += same_run.differences_of_groups(self.folder / one, self.folder / other, "run.h5", group)
        if self.settings and not damaged and one != "whole":
            differences.append("nothing was damaged in these steps: make HURRY faster")
        print(f"{one} and {other}: {len(names[0])} datasets, {len(frames[0])} frames{', damaged' if damaged else ''}: "
              f"{'equal bits' if not differences else 'DIFFERENT'}")
        return differences


    def ran_on(self, instructions):
        """The libraries that were opened are of this instruction set, or narrower where the processor has less."""
        with h5py.File(self.folder / instructions / "run.h5") as file:
            opened = [Path(line.decode().split()[-1]).parent.name for line in file["meta/plugins"][()] if b"move/verlet" in line]
        can = set(re.search(r"^flags\s*:(.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)[1].split())
        wanted = "avx2" if instructions == "avx2" and "avx2" in can else "beadwork"
        return [] if opened == [wanted] else [f"asked for {instructions}, opened {opened}"]


def count_of(left, right):
    left, right = numpy.asarray(left), numpy.asarray(right)
    if left.shape != right.shape:
        return f"shapes {left.shape} and {right.shape}"
    return f"{(left != right).sum()} of {left.size} numbers differ"


def same_bits(case):
    case.run("one", case.steps, 1)
    case.run("two", case.steps, 2)
    case.run("split", case.steps // 2 + 1, 1)
    case.run("split", case.steps, 1, "--resume")
    differences = case.compare("one", "two") + case.compare("one", "split")
    for instructions in ("avx2", "baseline"):
        os.environ["BEADWORK_INSTRUCTIONS"] = instructions
        case.run(instructions, case.steps, 1)
        differences += case.compare("one", instructions) + case.ran_on(instructions)
    del os.environ["BEADWORK_INSTRUCTIONS"]
    case.every = 1  # velocities are brought to the end of a step only where somebody looks
    case.run("looked", case.steps, 1)
    return differences + case.compare("one", "looked", alike=False)


def mixed(case):
    case.deck.write_text(case.deck.read_text().replace("<verlet ", '<verlet precision="mixed" '))
    return same_bits(case)


def step_of(folder):
    """The last step that a curve or a frame tells of; -1 before there is any."""
    rows = [curve.read_bytes().splitlines()[-1] for curve in (folder / "curves").glob("*.csv")]
    return max((int(row.split(b",")[0]) for row in rows if row[:1].isdigit() and b"," in row), default=-1)


def stopped(case, number):
    """Starts a run that would go on for ever, and ends it by a signal on its way; its exit code and what it said."""
    command = case.command("stopped", 10**9, 1, "--checkpoint-minutes", "0.002")
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        while process.poll() is None and not (step_of(case.folder / "stopped") >= case.steps // 2 and (case.folder / "stopped/checkpoint.h5").exists()):
            time.sleep(0.01)
        process.send_signal(number)
        said = process.communicate()[1]
    if not (case.folder / "stopped/checkpoint.h5").exists():
        sys.exit(f"FAILED: no checkpoint; exit code {process.returncode}\n{said}")
    return process.returncode, said


def goes_on(case):
    """From the checkpoint to some steps behind it; the same by a run without any stop."""
    with h5py.File(case.folder / "stopped/checkpoint.h5") as file:
        steps = int(file["meta"].attrs["step"])
    with h5py.File(case.folder / "stopped/run.h5") as file:
        print(f"run.h5 opens, {len(file.get('frames', {}))} frames; checkpoint at step {steps}")
    return [difference for end in (steps, steps + case.steps // 10) for difference in goes_on_to(case, end)]


def goes_on_to(case, end):
    """Where nothing is left to do, rows behind the checkpoint go all the same."""
    case.run("stopped", end, 1, "--resume")
    case.run("whole", end, 1, "--overwrite")
    return case.compare("whole", "stopped")


def killed(case):
    code, _ = stopped(case, signal.SIGKILL)
    return ([] if code == -signal.SIGKILL else [f"exit code {code}"]) + goes_on(case)


def terminated(case):
    code, said = stopped(case, signal.SIGTERM)
    wrong = [] if code == 5 else [f"exit code {code}, not 5"]
    if "--resume" not in said:
        wrong.append(f"no word on how to go on: {said}")
    return wrong + goes_on(case)


def resolved(case):
    case.run("one", case.steps)
    with tempfile.TemporaryDirectory() as elsewhere:
        command = [case.beadwork, "run", "-q", str(case.folder / "one/resolved.xml"), "--out", str(case.folder / "two"), "--threads", "1"]
        done = subprocess.run(command, cwd=elsewhere, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return [f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}"]
    return same_run.differences(case.folder / "one", case.folder / "two")


def main():
    os.environ.pop("OMP_NUM_THREADS", None)
    os.environ["OMP_WAIT_POLICY"] = "passive"  # two threads may have to share a core here
    questions = {"same_bits": same_bits, "mixed": mixed, "killed": killed, "resolved": resolved, "terminated": terminated}
    with tempfile.TemporaryDirectory() as folder:
        case = Case(sys.argv[1], Path(sys.argv[2]).resolve(), Path(folder))
        differences = questions[sys.argv[3]](case)
    print("\n".join(differences) or "passed")
    return 1 if differences else 0


sys.exit(main())
