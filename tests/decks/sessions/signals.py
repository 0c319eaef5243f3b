"""What the system does to a run while it goes on.   Usage: signals.py FOLDER signals | nohup-of-a-batch | closed-pipe | closed-streams | file-limit"""
import json
import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py

out = Path(sys.argv[1])


def command(name, *more):
    return ["beadwork", "run", "signals.xml", "--out", str(out / name), "--threads", "1", *more]


def summary(name):
    return json.loads((out / name / "summary.json").read_text())


def undisturbed(end):
    subprocess.run([*command("whole", "--overwrite", "--set", f"end={end}"), "-q"], check=True)


def same_curves(name):
    for file in (out / "whole/curves").iterdir():
        assert file.read_bytes() == (out / name / "curves" / file.name).read_bytes(), (name, file.name)


def wait_for_rows(name, process):
    curve = out / name / "curves/force.csv"
    while not curve.exists() or curve.read_text().count("\n") < 20:
        assert process.poll() is None, process.returncode
        time.sleep(0.01)


def signals():
    """Each ends the run in order, and it goes on from there."""
    for number in (signal.SIGHUP, signal.SIGXCPU, signal.SIGUSR1, signal.SIGTERM):
        name = number.name
        process = subprocess.Popen([*command(name, "--set", "end=1000000000"), "-q"], stderr=subprocess.PIPE, text=True)
        wait_for_rows(name, process)
        process.send_signal(number)
        assert process.wait() == 5, (name, process.returncode, process.stderr.read())
        step = summary(name)["steps"]
        assert summary(name)["status"] == "interrupted" and step > 0, summary(name)
        subprocess.run([*command(name, "--resume", "--set", f"end={step + 100}"), "-q"], check=True)
        undisturbed(step + 100)
        same_curves(name)
    kept = subprocess.Popen(["nohup", *command("nohup", "--set", "end=20000"), "-q"], stderr=subprocess.DEVNULL)
    wait_for_rows("nohup", kept)
    kept.send_signal(signal.SIGHUP)
    assert kept.wait() == 0, "nohup asks to be left alone by SIGHUP"


def nohup_of_a_batch():
    """The terminal is closed, and all of its processes hear of it: batch and runs go on."""
    command = ["beadwork", "batch", "signals.xml", "--out", str(out / "batch"), "--threads", "1", "--vary", "end=30000,30001"]
    batch = subprocess.Popen(["nohup", *command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    for name in ("batch/end=30000", "batch/end=30001"):
        wait_for_rows(name, batch)
    os.killpg(batch.pid, signal.SIGHUP)
    assert batch.wait() == 0, batch.returncode
    assert summary("batch/end=30000")["status"] == summary("batch/end=30001")["status"] == "done"


def closed_pipe():
    """Nobody reads what the run says: it goes on, and its log is whole."""
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(command("pipe"), stdout=write, stderr=write, check=False)
    assert done.returncode == 0, done.returncode
    undisturbed(200)
    same_curves("pipe")
    assert summary("pipe")["status"] == "done"
    words = [[line.split(" ", 3)[3] for line in (out / name / "run.log").read_text().splitlines()] for name in ("pipe", "whole")]
    assert len(words[0]) == len(words[1]) >= 3 and words[0][-1].startswith("done: "), words


def closed_streams():
    """No file of the run takes what was meant for the terminal."""
    quoted = " ".join(f"'{word}'" for word in command("streams"))
    done = subprocess.run(["bash", "-c", f"exec {quoted} 0<&- 1>&- 2>&-"], check=False)
    assert done.returncode == 0, done.returncode
    undisturbed(200)
    same_curves("streams")
    with h5py.File(out / "streams/checkpoint.h5") as file:
        assert file["meta"].attrs["step"] == 200
    assert "done: " in (out / "streams/run.log").read_text().splitlines()[-1]


def file_limit():
    """A file that may not grow is an error of the machine, with a summary that says so and a checkpoint of the last step."""
    limit = 100000

    def set_limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    done = subprocess.run([*command("limit", "--set", "end=100000"), "-q"], preexec_fn=set_limit, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1, (done.returncode, done.stderr)
    assert "File too large" in done.stderr and "ulimit -f" in done.stderr, done.stderr
    ended = summary("limit")
    assert ended["status"] == "failed" and f"newest checkpoint is of step {ended['steps']}," in ended["exit_reason"], ended
    end = ended["steps"] + 100
    subprocess.run([*command("limit", "--resume", "--set", f"end={end}"), "-q"], check=True)
    undisturbed(end)
    same_curves("limit")


{"signals": signals, "nohup-of-a-batch": nohup_of_a_batch, "closed-pipe": closed_pipe, "closed-streams": closed_streams, "file-limit": file_limit}[sys.argv[2]]()
