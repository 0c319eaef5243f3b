#!/usr/bin/python3
"""Kills a run, a calibration or a batch at random moments, again and again, and goes on: what comes out is what comes out without any kill.
Usage: kills.py BEADWORK DECK [ROUNDS] [SEED] [--verb run|calibrate|batch]

A round is a command that is killed until it gets to its end; rounds go on until half as many kills have come before the end. Of a run
checkpoints follow one another as fast as they can be written, and watchers look often, so that kills come between a checkpoint and a
look, in the midst of either, and where a stage begins. A calibration and a batch are killed with all that they have started still
running; the same command takes them up.
"""
import argparse
import csv
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
import same_run  # noqa: E402


class Run:
    """One run, which resumes from its checkpoint."""

    def __init__(self, beadwork, deck):
        self.words = [beadwork, "run", "-q", str(deck), "--threads", "1", "--checkpoint-minutes", "1e-9"]

    def command(self, out):
        go_on = "--resume" if (out / "checkpoint.h5").exists() else "--overwrite"
        return [*self.words, "--out", str(out), go_on]

    def differences(self, whole, out):
        return same_run.differences(whole, out)


class Calibrate:
    """A calibration, with the samples that it runs."""

    def __init__(self, beadwork, deck):
        self.words = [beadwork, "calibrate", "-q", str(deck), "--jobs", "2", "--threads", "1"]

    def command(self, out):
        return [*self.words, "--out", str(out)]

    def differences(self, whole, out):
        files = sorted(p.relative_to(whole) for pattern in ("*.calibration.xml", "curves/*.csv") for p in whole.glob(pattern))
        if not files:
            return "nothing was found"
        return next((f"{name} differs" for name in files if (whole / name).read_text() != (out / name).read_text()), "")


class Batch:
    """A study with runs that wait for others."""

    def __init__(self, beadwork, deck):
        self.words = [beadwork, "batch", str(deck), "--jobs", "2", "--threads", "1"]

    def command(self, out):
        return [*self.words, "--out", str(out)]

    def differences(self, whole, out):
        def table(folder):
            with open(folder / "batch.csv", newline="", encoding="utf-8") as file:
                return [{k: v for k, v in row.items() if "seconds" not in k} for row in csv.DictReader(file)]

        if table(whole) != table(out):
            return "batch.csv differs"
        if not all(row["status"] == "done" for row in table(out)):
            return "not all runs are done"
        return next((f"{row['run']}: {found}" for row in table(whole) if (found := same_run.differences(whole / row["run"], out / row["run"]))), "")


def to_the_end(work, out):
    done = subprocess.run(work.command(out), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"FAILED: {' '.join(done.args)}: exit code {done.returncode}\n{done.stdout}{done.stderr}")


def killed_after(seconds, work, out):
    """Whether the kill came before the end."""
    with tempfile.TemporaryFile("w+") as said, subprocess.Popen(work.command(out), stdout=said, stderr=said) as process:
        time.sleep(seconds)
        was_running = process.poll() is None
        process.kill()
        process.wait()
        if not was_running and process.returncode != 0:
            said.seek(0)
            sys.exit(f"FAILED: exit code {process.returncode}\n{said.read()}")
    return was_running


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("beadwork")
    parser.add_argument("deck", type=Path)
    parser.add_argument("rounds", type=int, nargs="?", default=6)
    parser.add_argument("seed", type=int, nargs="?", default=1)
    parser.add_argument("--verb", choices=("run", "calibrate", "batch"), default="run")
    arguments = parser.parse_args()
    work = {"run": Run, "calibrate": Calibrate, "batch": Batch}[arguments.verb](arguments.beadwork, arguments.deck.resolve())
    chance = random.Random(arguments.seed)
    kills = 0
    with tempfile.TemporaryDirectory() as folder:
        whole = Path(folder) / "whole"
        began = time.monotonic()
        to_the_end(work, whole)
        takes = time.monotonic() - began
        number = 0
        while number < arguments.rounds or kills < arguments.rounds // 2:
            out, before = Path(folder) / f"round{number}", kills
            if arguments.verb == "batch":  # where a run stands is part of what others are given
                whole.rename(Path(folder) / "kept")
                out = whole
            for _ in range(5):
                if not killed_after(chance.uniform(0, 0.7) * takes, work, out):
                    break
                kills += 1
            to_the_end(work, out)
            if arguments.verb == "batch":
                out.rename(Path(folder) / f"round{number}")
                (Path(folder) / "kept").rename(whole)
                out = Path(folder) / f"round{number}"
            if found := work.differences(whole, out):
                print(f"round {number}: {found}")
                return 1
            number += 1
            if kills == before:
                takes /= 2  # the machine is faster than it was: the next kills come earlier
    print(f"{number} rounds, {kills} kills: as without any stop")
    return 0


sys.exit(main())
