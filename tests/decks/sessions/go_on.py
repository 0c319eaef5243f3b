"""Stops a run on its way, and pastes the command that is told for going on into a shell.   Usage: go_on.py OUT"""
import json
import signal
import subprocess
import sys
import time
from pathlib import Path

run = Path(sys.argv[1]) / "it's a run"
SETTINGS = {"title": "it's $HOME; a \"pair\"", "E": "2 GPa"}


def step():
    """That of the last row of the curve."""
    curve = run / "curves/force.csv"
    rows = curve.read_text(encoding="utf-8").splitlines()[1:] if curve.exists() else []
    return int(rows[-1].split(",")[0]) if rows else 0


def stop(command):
    """Starts, waits for a row more, and ends it as Ctrl-C does; the command for going on."""
    before = step()
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        while process.poll() is None and step() <= before:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1]
    assert process.returncode == 5, said
    state = json.loads((run / "summary.json").read_text(encoding="utf-8"))
    assert state["overrides"] == SETTINGS and state["threads"] == 1, state
    assert state["exit_reason"] == said.strip(), (state["exit_reason"], said)
    return said.strip().split("go on with: ")[1], state["steps"]


settings = [word for name, value in SETTINGS.items() for word in ("--set", f"{name}={value}")]
told, steps = stop(["beadwork", "run", "-q", "go_on.xml", "--threads", "1", "--out", str(run), *settings])
told_again, more = stop(["bash", "-c", f"exec {told}"])
assert f"resumed at step {steps}" in (run / "run.log").read_text(encoding="utf-8")
assert more > steps and told_again == told, (told, told_again)
