#!/usr/bin/python3
"""No two types of one namespace have one name: the linker would keep one copy of their inline functions, whichever.
Usage: one_definition.py SOURCE_FOLDER"""
import re
import sys
from pathlib import Path


def types_of(text):
    """(namespace, name) of the types that are defined in a namespace that other files can see."""
    spaces = []
    for line in text.splitlines():
        opened = re.match(r"namespace\s*([\w:]*)\s*\{", line)
        if opened:
            spaces.append(opened.group(1) or "(own)")
        elif line.startswith("}  // namespace") and spaces:
            spaces.pop()
        found = re.match(r"(?:class|struct)\s+(\w+)(?:\s+final)?\s*(?::(?!:)[^;]*)?\{", line)
        if found and "(own)" not in spaces:
            yield "::".join(spaces), found.group(1)


def main():
    root = Path(sys.argv[1])
    seen, wrong = {}, []
    for top in ("core", "workbench"):  # plugin libraries hide their names
        for file in sorted((root / top).rglob("*.[ch]pp")):
            for key in types_of(file.read_text()):
                if key in seen and seen[key] != file:
                    wrong.append(f"{'::'.join(key)} is in {seen[key].relative_to(root)} and in {file.relative_to(root)}")
                seen[key] = file
    print("\n".join(wrong) or f"{len(seen)} types, each defined once")
    return 1 if wrong else 0


sys.exit(main())
