#!/usr/bin/python3
"""`beadwork new PLUGIN` is well-formed XML, and `check` names just what is to be filled in: each required attribute, once.
Usage: skeletons.py BEADWORK"""
import json
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


def mistakes(beadwork, plugin, deck):
    made = run(beadwork, "new", f"{plugin['section']}/{plugin['tag']}", "--out", str(deck))
    if made.returncode != 0:
        return [made.stderr]
    xml.etree.ElementTree.parse(deck)
    checked = run(beadwork, "check", str(deck)).stderr
    named = re.findall(r"error: '([a-z0-9-]+)' ", checked)
    wanted = [p["name"] for p in plugin["parameters"] if p["required"]]
    groups = {p["one_of"]: p["name"] for p in reversed(plugin["parameters"]) if "one_of" in p}  # the first of each is written
    wanted += groups.values()
    if plugin["section"] == "move":
        wanted.append("until")
    # A condition complains of its expression, not by its name.
    conditions = sum(p["type"] == "condition" for p in plugin["parameters"] if p["required"])
    named_once = sorted(named) == sorted(w for w in wanted if w in named) and len(wanted) - len(named) == conditions
    return [] if named_once else [f"wanted {wanted}, check named {named}:\n{checked}"]


def main():
    beadwork = sys.argv[1]
    wrong = []
    plugins = [p for p in json.loads(run(beadwork, "describe", "--format", "json").stdout) if p["section"] != "derive"]
    with tempfile.TemporaryDirectory() as folder:
        for number, plugin in enumerate(plugins):
            for mistake in mistakes(beadwork, plugin, Path(folder) / f"deck{number}.xml"):
                wrong.append(f"{plugin['section']}/{plugin['tag']}: {mistake}")
    print("\n".join(wrong) or f"{len(plugins)} skeletons")
    return 1 if wrong else 0


sys.exit(main())
