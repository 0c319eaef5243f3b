#!/usr/bin/python3
"""Kills a run at random moments, again and again, and resumes it: curves, frames, breaks and state are those of a run without any stop.
Usage: kills.py BEADWORK DECK [ROUNDS] [SEED]

A round is a run that is killed until it gets to its end; rounds go on until half as many kills have come before the end. Checkpoints
follow one another as fast as they can be written, and watchers look often, so that kills come between a checkpoint and a look, in the
midst of either, and where a stage begins.
"""
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))
import same_run  # noqa: E402


def command(beadwork, deck, out, *more):
    return [beadwork, "run", "-q", str(deck), "--out", str(out), "--threads", "1", "--checkpoint-minutes", "1e-9", *more]


def to_the_end(beadwork, deck, out, *more):
    done = subprocess.run(command(beadwork, deck, out, *more), capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"FAILED: {' '.join(done.args)}: exit code {done.returncode}\n{done.stderr}")


def killed_after(seconds, beadwork, deck, out):
    """Whether the kill came before the end."""
    go_on = ["--resume"] if (out / "checkpoint.h5").exists() else ["--overwrite"]
    with subprocess.Popen(command(beadwork, deck, out, *go_on), stderr=subprocess.PIPE, text=True) as process:
        time.sleep(seconds)
        was_running = process.poll() is None
        process.kill()
        said = process.communicate()[1]
    if not was_running and process.returncode != 0:
        sys.exit(f"FAILED: exit code {process.returncode}\n{said}")
    return was_running


def main():
    beadwork, deck = sys.argv[1], Path(sys.argv[2]).resolve()
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 6
    chance = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
    kills = 0
    with tempfile.TemporaryDirectory() as folder:
        whole = Path(folder) / "whole"
        began = time.monotonic()
        to_the_end(beadwork, deck, whole)
        takes = time.monotonic() - began
        number = 0
        while number < rounds or kills < rounds // 2:
            out, before = Path(folder) / f"round{number}", kills
            for _ in range(5):
                if not killed_after(chance.uniform(0, 0.7) * takes, beadwork, deck, out):
                    break
                kills += 1
            to_the_end(beadwork, deck, out, "--resume" if (out / "checkpoint.h5").exists() else "--overwrite")
            if found := same_run.differences(whole, out):
                print(f"round {number}: {found}")
                return 1
            number += 1
            if kills == before:
                takes /= 2  # the machine is faster than it was: the next kills come earlier
    print(f"{number} rounds, {kills} kills: as without any stop")
    return 0


sys.exit(main())
