#!/usr/bin/python3
"""Who includes whom: every part of the program includes only the parts that stand below it; and who has threads: one file."""
import re
import sys
from pathlib import Path

PLUGIN_BASE = {"base", "deck", "domain", "mechanics", "bonds", "plugin"}
ALLOWED = {
    "base": set(),
    "deck": {"base"},
    "mechanics": {"base"},
    "domain": {"base", "mechanics"},
    "io": {"base", "domain", "mechanics"},
    "packing": {"base", "domain"},
    "bonds": {"base", "domain", "mechanics"},
    "plugin": {"base", "deck", "domain", "mechanics", "bonds"},
    "dynamics": {"base", "domain", "mechanics", "bonds", "plugin"},
    "statics": {"base", "domain", "mechanics", "bonds", "plugin"},
    "loop": {"base", "deck", "domain", "mechanics", "plugin", "io"},
    "workbench": {"base", "deck", "domain", "mechanics", "plugin", "loop", "io", "packing"},
    "plugins/fill": PLUGIN_BASE | {"packing", "io"},
    "plugins/watch": PLUGIN_BASE | {"io"},
    **{f"plugins/{kind}": PLUGIN_BASE for kind in ("bond", "contact", "load", "fail", "derive", "study")},
    "plugins/move": PLUGIN_BASE | {"dynamics", "statics"},
}
# Each of these libraries is known to one part only.
OWNERS = {"tinyxml2.h": "deck", "muParser.h": "deck", "hdf5.h": "io", "boost/dll/": "plugin",
          "udunits2.h": "base", "boost/geometry": "domain", "CLI/": "workbench", "spdlog/": "workbench",
          "png.h": "workbench", "dmumps_c.h": "statics", "metis.h": "statics"}


def part_of(path):
    """core/deck/deck.hpp -> deck; plugins/bond/spring.cpp -> plugins/bond; workbench/report/x.cpp -> workbench."""
    pieces = path.split("/")
    if pieces[0] == "core":
        return pieces[1] if len(pieces) > 2 else "base"  # core/version.hpp
    return "/".join(pieces[:2]) if pieces[0] == "plugins" else pieces[0]


OURS = ("core/", "plugins/", "workbench/", "tests/")


def objection(part, included, quoted=True):
    if part not in ALLOWED:
        return f"there is no part '{part}': say in {Path(__file__).name} what it may include"
    if included.startswith(OURS):
        if included.endswith(".cpp"):
            return "sources are compiled, not included"
        there = part_of(included)
        if there == part or there in ALLOWED[part]:
            return None
        return f"{part} may not include {there}"
    if quoted:
        return "a file of ours is included by its path from the top"
    for library, owner in OWNERS.items():
        if included.startswith(library) and owner != part:
            return f"only {owner} includes {library}"
    return None


# What must not pass, lest the guard sleeps.
SINS = [("deck", "core/domain/table.hpp", True), ("core/new", "core/base/types.hpp", True), ("plugins/new", "core/base/types.hpp", True), ("plugins/study", "core/loop/run.hpp", True), ("domain", "../loop/run.hpp", True),
        ("domain", "table.hpp", True), ("plugins/bond", "core/dynamics/grips.hpp", True), ("plugins/bond", "plugins/bond/spring.cpp", True), ("plugins/fail", "core/io/h5.hpp", True),
        ("loop", "hdf5.h", False), ("io", "png.h", False), ("loop", "workbench/signals.hpp", True), ("io", "core/plugin/kinds.hpp", False), ("base", "tests/support/scratch.hpp", True)]


def main():
    root = Path(sys.argv[1])
    wrong = [f"{part} includes {included}, and nobody minds" for part, included, quoted in SINS if not objection(part, included, quoted)]
    files = [f for top in ("core", "plugins", "workbench") for f in sorted((root / top).rglob("*")) if f.suffix in (".hpp", ".cpp")]
    for file in files:
        name = str(file.relative_to(root))
        for number, line in enumerate(file.read_text().splitlines(), 1):
            found = re.match(r'\s*#\s*include\s*([<"])([^>"]+)', line)
            why = found and objection(part_of(name), found.group(2), found.group(1) == '"')
            if re.match(r"\s*#\s*(pragma\s+omp|include\s*<omp\.h>)", line):
                why = "threads share loops through core/base/parallel.hpp alone"
            if why:
                wrong.append(f"{name}:{number}: {line.strip()}: {why}")
    print("\n".join(wrong) or f"{len(files)} files include in the right direction")
    return 1 if wrong else 0


sys.exit(main())
