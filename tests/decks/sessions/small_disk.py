"""Runs the deck with ever less room on the disk: it ends well or says why, and never without a word.   Usage: small_disk.py DISK"""
import json
import subprocess
import sys
from pathlib import Path

disk = Path(sys.argv[1])
codes = set()
for filled in range(700, 1024, 4):
    subprocess.run(["rm", "-rf", disk / "run"], check=True)
    (disk / "filler").write_bytes(b"")  # the room of the last one first
    (disk / "filler").write_bytes(bytes(1024 * filled))
    done = subprocess.run(["beadwork", "run", "-q", "small_disk.xml", "--out", disk / "run", "--threads", "1"], capture_output=True, text=True, check=False)
    codes.add(done.returncode)
    where = f"{filled} KiB filled: exit {done.returncode}, {done.stderr}"
    assert done.returncode in (0, 1), where
    assert done.returncode == 0 or "the disk is full" in done.stderr, where
    summary = disk / "run/summary.json"
    if done.returncode == 1 and summary.exists() and summary.stat().st_size:
        assert json.loads(summary.read_text())["status"] == "failed", where
assert codes == {0, 1}, codes
