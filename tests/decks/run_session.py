#!/usr/bin/python3
"""What the program says, to the letter: of a bad deck, or over several commands.   Usage: run_session.py BEADWORK EXPECT [--record]

An .expect file is a session at a terminal, in the folder of the decks:

    # a remark
    $ beadwork check misspelt_tag.xml
    ... what it writes to standard error ...
    [exit 2]

$OUT is a fresh folder. Where a session names $DISK, that is a disk of 1 MB. --record writes down what was said: read it
before you commit it.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77


def session(expect):
    """Commands in order, each with the lines expected of it, and the remarks above it."""
    steps, remarks = [], []
    for line in expect.read_text().splitlines():
        if line.startswith("# "):
            remarks.append(line)
        elif line.startswith("$ "):
            steps.append((remarks, line[2:], []))
            remarks = []
        else:
            steps[-1][2].append(line)
    return steps


def said(command, beadwork, here, out):
    places = {"OUT": str(out), "DISK": str(out / "disk"), "BEADWORK_PLUGINS": "", "OMP_NUM_THREADS": "1"}
    path = {"PATH": f"{beadwork.parent}:{os.environ['PATH']}"}
    done = subprocess.run(["bash", "-c", command], cwd=here, env={**os.environ, **places, **path}, capture_output=True, text=True,
                          errors="replace", timeout=300, check=False)
    text = done.stderr.replace(str(out / "disk"), "$DISK").replace(str(out), "$OUT").replace(f"{here}/", "")
    return [*text.splitlines(), f"[exit {done.returncode}]"]


def main():
    beadwork, expect = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    steps = session(expect)
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        disk = out / "disk"
        if any("$DISK" in command for _, command, _ in steps):
            disk.mkdir()
            mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "none", disk], capture_output=True, text=True, check=False)
            if mount.returncode != 0:
                print(f"skipped: a small disk cannot be mounted here: {mount.stderr.strip()}")
                return SKIPPED
        try:
            recorded = []
            for remarks, command, wanted in steps:
                got = said(command, beadwork, expect.parent, out)
                if got[-1] == f"[exit {SKIPPED}]":
                    print("\n".join(got[:-1]))
                    return SKIPPED
                recorded += [*remarks, f"$ {command}", *got]
                if not matches(wanted, got):
                    wrong.append("\n".join([f"$ {command}", "--- wanted", *wanted, "--- got", *got]))
        finally:
            if os.path.ismount(disk):
                subprocess.run(["umount", disk], check=True)
    if "--record" in sys.argv:
        expect.write_text("\n".join(recorded) + "\n")
        return 0
    print("\n".join(wrong) or "as expected")
    return 1 if wrong else 0


def matches(wanted, got):
    """Line by line; <...> in a wanted line stands for any text."""
    pattern = [re.escape(line).replace(re.escape("<...>"), ".*") for line in wanted]
    return len(wanted) == len(got) and all(re.fullmatch(p, g) for p, g in zip(pattern, got))


sys.exit(main())
