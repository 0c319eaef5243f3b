"""Everything in a run's folder that is text can be read as such: odd_bytes.py FOLDER"""
import json
import sys
import xml.dom.minidom
from pathlib import Path

for file in Path(sys.argv[1]).rglob("*"):
    if not file.is_file() or file.suffix == ".h5":
        continue
    text = file.read_bytes().decode("utf-8")
    odd = [c for c in text if ord(c) < 32 and c not in "\n\t"]
    assert not odd, f"{file.name}: {odd}"
    if file.suffix == ".json":
        json.loads(text)
    if file.suffix in (".xml", ".xmf", ".xdmf"):
        xml.dom.minidom.parseString(text)
summary = json.loads((Path(sys.argv[1]) / "summary.json").read_text())
print(summary["status"], ascii(summary["name"]), file=sys.stderr)
