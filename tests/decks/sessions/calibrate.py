"""What a calibration leaves.   Usage: calibrate.py FOLDER found|known|waves|killed [DECK]"""
import json
import os
import random
import re
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as xml
from pathlib import Path

folder = Path(sys.argv[1])
summary = json.loads((folder / "summary.json").read_text())
result = summary["result"]


def found():
    """The samples have what was wanted, in figures of their own."""
    values = {p.get("name"): p.get("value") for p in xml.parse(folder / "resin.calibration.xml").getroot()}
    assert set(values) == {f"resin.{n}" for n in ("radius-ratio", "young", "poisson", "density", "bbf-strength", "rdef-strength")}, values
    assert summary["status"] == "done" and summary["runs"]["known"] == 0, summary
    assert abs(result["poisson"]["mean"] - 0.25) < 1e-3, result["poisson"]
    modulus = float(values["resin.young"].split()[0]) * result["modulus_ratio"]["reaction_through_centres"]["mean"]
    assert abs(modulus / 4e9 - 1) < 1e-3, modulus
    for criterion in ("bbf-axial-bending", "rdef"):
        assert len(result[criterion]["peak"]["samples"]) == 2
        assert abs(result[criterion]["peak"]["mean"] / 60e6 - 1) < 0.05, result[criterion]
    said = result["tests"]
    assert [t for t in ("tension", "compression", "bending", "torsion", "wave") if t in said] == ["tension", "compression", "bending", "torsion"], said
    assert len(said["tension"]["young"]["over_section"]["samples"]) == 1, said["tension"]
    assert said["farthest_from_tension"]["over_section"] < 0.5, said
    assert (folder / "resin.calibration.xml").read_text().count("\n       compression ") == 1
    line = [[float(cell) for cell in row.split(",")] for row in (folder / "curves" / "young.csv").read_text().splitlines()[1:]]
    assert len(line) == 3 and max(abs(b / a / result["tests"]["tension"]["young"]["over_section"]["mean"] * line[1][0] - 1) for a, b in line) < 1e-6, line
    first = (folder / "curves" / "poisson.csv").read_text().splitlines()
    assert first[0] == "radius-ratio [1],poisson [1],deviation [1],seed-1 [1],seed-2 [1]", first[0]
    rows = [[float(cell) for cell in line.split(",")] for line in first[1:]]
    assert all(a[0] < b[0] and a[1] > b[1] for a, b in zip(rows, rows[1:])), rows  # it falls
    report = (folder / "report.html").read_text()
    assert "<svg" in report and re.search(r"<pre>test .*\ntension .*\ncompression .*\nbending .*\ntorsion .*\ncore ", report)


def known():
    assert summary["runs"]["run"] == 0 and summary["runs"]["known"] > 15, summary["runs"]


def waves():
    """Of both samples, each along a rod of its own."""
    said = result["tests"]
    assert "bending" not in said and len(said["tension"]["young"]["over_section"]["samples"]) == 2, said
    assert len(said["wave"]["over_that"]["samples"]) == 2 and 0.8 < said["wave"]["over_that"]["mean"] < 1.1, said["wave"]
    assert 0.97 < said["wave"]["share_bound"]["mean"] < 1, said["wave"]
    assert len(list((folder / "runs").glob("rod-wave,seed=*"))) == 2


def killed():
    chance = random.Random(1)
    other = folder.parent / "killed"
    command = ["beadwork", "calibrate", sys.argv[3], "--out", str(other), "--jobs", "2"]
    kills = 0
    for _ in range(6):
        with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
            time.sleep(chance.uniform(0.2, 2))
            kills += process.poll() is None
            process.kill()
    # and once more, asked kindly
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        time.sleep(0.5)
        running = process.poll() is None
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1]
    assert not running or (process.returncode == 5 and "go on with: beadwork calibrate" in said), (process.returncode, said)
    assert kills >= 2, kills
    subprocess.run(command, stdout=subprocess.DEVNULL, check=True)
    for name in ("resin.calibration.xml", "curves/poisson.csv", "curves/stiffness.csv"):
        assert (other / name).read_bytes() == (folder / name).read_bytes(), name


os.environ.setdefault("PATH", os.defpath)
{"found": found, "known": known, "killed": killed, "waves": waves}[sys.argv[2]]()
