"""What stands in the folder of a run, but for its log, is what stood there.   Usage: others.py RUN remember | same"""
import hashlib
import json
import sys
from pathlib import Path

run = Path(sys.argv[1])
memory = run.with_suffix(".remembered")
now = {str(file.relative_to(run)): hashlib.sha256(file.read_bytes()).hexdigest() for file in sorted(run.rglob("*")) if file.is_file() and file.name != "run.log"}
if sys.argv[2] == "remember":
    memory.write_text(json.dumps(now))
else:
    before = json.loads(memory.read_text())
    assert now == before, [name for name in {*now, *before} if now.get(name) != before.get(name)]
