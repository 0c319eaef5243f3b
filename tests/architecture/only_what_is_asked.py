#!/usr/bin/python3
"""Each shipped deck allocates and computes only what a plugin of it asks for, as its plan tells.   Usage: only_what_is_asked.py SOURCE BEADWORK"""
import re
import subprocess
import sys
from pathlib import Path

OWN = {"utilisation"}  # what a criterion offers it reads itself, to tell what has reached it
NEEDED = ("core", "keeps:", "adds:", "reads:", "fills:", "sums up:", "writes:")
COLUMN = re.compile(r"^  (\S+) +\d+ bytes  (.*)$")


def parts_of(plan):
    """Lines by their heading."""
    parts, heading = {}, ""
    for line in plan.splitlines():
        if line and not line.startswith(" "):
            heading = line.split(":")[0].split(",")[0]
        elif line.strip():
            parts.setdefault(heading, []).append(line)
    return parts


def wrong_in(plan):
    parts = parts_of(plan)
    works = " ".join(line for heading, lines in parts.items() if heading.startswith(("Stage", "Before")) for line in lines)
    idle = " ".join(parts.get("Not needed", []))
    columns = {}
    for heading, lines in parts.items():
        if heading.startswith("Columns"):
            columns[heading] = {m[1]: m[2] for line in lines if (m := COLUMN.match(line))}
            for name, why in columns[heading].items():
                if not any(word in why for word in NEEDED) and name not in OWN:
                    yield f"{heading}: nobody needs {name}"
                for plugin in re.findall(r"[a-z][a-z0-9-]+(?=[,;]|$)", why.split(":", 1)[1] if ":" in why else ""):
                    if plugin not in works:
                        yield f"{heading}: {name} is for {plugin}, which does no work"
    elements = next((c for h, c in columns.items() if h.startswith("Columns on elements")), {})
    if not elements:
        yield "no columns"
    turns = "adds:" in elements.get("torque", "") or "reads:" in elements.get("orientation", "")
    for name in ("orientation", "spin", "torque", "inertia"):
        if name in elements and not turns and not any(w in elements[name] for w in ("reads:",)):
            yield f"{name} is there, and nothing turns"
    if ("search for neighbours" in idle) == ("  contact  " in works):
        yield "a search for neighbours without contacts, or contacts without one"


def main():
    source, beadwork = Path(sys.argv[1]), sys.argv[2]
    planned, wrong = 0, []
    for deck in sorted((source / "xml-cases").rglob("*.xml")):
        done = subprocess.run([beadwork, "plan", str(deck)], capture_output=True, text=True, check=False)
        if done.returncode not in (0, 2):
            wrong.append(f"{deck.relative_to(source)}: exit code {done.returncode}: {done.stderr[-300:]}")
        if done.returncode != 0:
            continue  # a part of other decks, a study, or one that needs a packing which is made first
        planned += 1
        wrong += [f"{deck.relative_to(source)}: {each}" for each in wrong_in(done.stdout)]
    print("\n".join(wrong) or f"{planned} decks")
    return bool(wrong) or planned < 60


sys.exit(main())
