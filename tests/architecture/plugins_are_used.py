#!/usr/bin/python3
"""Every plugin stands in a deck that is run or checked, or in a test that names it."""
import re
import sys
from pathlib import Path


def main():
    root = Path(sys.argv[1])
    files = [f for folder in ("xml-cases", "tests") for f in sorted((root / folder).rglob("*.xml"))]
    decks = "".join(f.read_text() for f in files if "decks/bad" not in str(f))  # what is refused is no use
    tests = "".join(f.read_text() for f in sorted((root / "tests").rglob("*.[ch]pp")))
    unused = []
    plugins = sorted(root.glob("plugins/*/*.cpp"))
    for source in plugins:
        kind, tag = source.parent.name, source.stem.replace("_", "-")
        read_by_name = kind == "derive" and re.search(rf'"[^"]*\b{re.escape(tag)}\b[^"]*"', decks + tests)
        if not read_by_name and not re.search(rf"<{re.escape(tag)}[\s/>]", decks + tests):
            unused.append(f"{source.relative_to(root)}: no deck and no test uses <{tag}>")
    print("\n".join(unused) or f"{len(plugins)} plugins are used")
    return 1 if unused else 0


sys.exit(main())
