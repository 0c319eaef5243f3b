#!/usr/bin/python3
"""The manual at a terminal: what a plugin is and does, in lines that fit, and no table of Markdown.   Usage: describe.py BEADWORK"""
import re
import subprocess
import sys

beadwork = sys.argv[1]


def described(*words):
    return subprocess.run([beadwork, "describe", *words], capture_output=True, text=True, check=True).stdout


listed = described()
plugins = re.findall(r"(?m)^  ([a-z][a-z-]*) ", listed)
assert len(plugins) > 15, listed
wrong = []
for words in [()] + [(plugin,) for plugin in sorted(set(plugins))]:
    name = " ".join(words) or "the list"
    lines = described(*words).splitlines()
    wrong += [f"{name}: {len(line)} letters: {line}" for line in lines if len(line) > 100]
    wrong += [f"{name}: a table: {line}" for line in lines if re.match(r"\s*\|", line) or "---" in line]
beam = described("cohesive-beam")
for part in ("<cohesive-beam>  in section <bond>", "\nAttributes\n", "\n  young\n", "required", "\nFields\n"):
    if part not in beam:
        wrong.append(f"cohesive-beam lacks {part!r}: {beam}")
print("\n".join(wrong) or f"{len(plugins)} plugins are described")
sys.exit(1 if wrong else 0)
