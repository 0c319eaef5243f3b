#!/usr/bin/python3
"""Every block of C++ and CMake in docs/writing-a-plugin.md stands, word by word, in code that is compiled.
Usage: docs_code_is_real.py SOURCE_FOLDER"""
import re
import sys
from pathlib import Path

CODE = ["tools/plugin-template/bond/rope.cpp", "tools/plugin-template/load/shake.cpp", "tools/plugin-template/watch/centroid.cpp",
        "tools/plugin-template/CMakeLists.txt", "tests/architecture/installed_package/tripwire.cpp", "tests/laws/damped_spring.cpp",
        "plugins/fail/bond_stress.cpp", "plugins/derive/displacement.cpp"]


def main():
    root = Path(sys.argv[1])
    text = (root / "docs/writing-a-plugin.md").read_text()
    code = [(root / file).read_text() for file in CODE]
    blocks = re.findall(r"```(?:cpp|cmake)\n(.*?)```", text, re.S)
    strange = [block for block in blocks if not any(block in each for each in code)]
    named = re.findall(r"`(plugins/\w+/\w+\.cpp|core/[\w/]+\.hpp)`", text)
    missing = [file for file in named if not (root / file).exists()]
    for block in strange:
        print(f"no such code in {', '.join(CODE)}:\n{block}")
    for file in missing:
        print(f"there is no {file}")
    if not strange and not missing:
        print(f"{len(blocks)} blocks of code and {len(named)} files are real")
    return 1 if strange or missing or not blocks else 0


sys.exit(main())
