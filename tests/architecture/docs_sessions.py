#!/usr/bin/python3
"""What the docs show of a terminal is what the program says: each block that begins with "$ beadwork", to the letter.
Usage: docs_sessions.py SOURCE_FOLDER BEADWORK"""
import os
import re
import subprocess
import sys
from pathlib import Path


def said(command, root, beadwork):
    path = {"PATH": f"{beadwork.parent}:{os.environ['PATH']}"}
    done = subprocess.run(["bash", "-c", command], cwd=root, env={**os.environ, **path}, capture_output=True, text=True, check=False)
    return done.stdout + done.stderr


def main():
    root, beadwork = Path(sys.argv[1]), Path(sys.argv[2]).resolve()
    shown = [(file, *block) for file in [root / "README.md", *sorted((root / "docs").rglob("*.md"))]
             for block in re.findall(r"```\n\$ (beadwork .*)\n((?s:.*?))```", file.read_text())]
    wrong = [f"{file.relative_to(root)}: $ {command}\n--- shown\n{text}--- said\n{now}"
             for file, command, text in shown if (now := said(command, root, beadwork)) != text]
    print("\n".join(wrong) or f"{len(shown)} sessions are as shown")
    return 1 if wrong or not shown else 0


sys.exit(main())
