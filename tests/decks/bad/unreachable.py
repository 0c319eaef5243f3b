"""Writes decks that name what no file system can reach, beside links that go round: unreachable.py FOLDER"""
import os
import sys
from pathlib import Path

folder = Path(sys.argv[1])
long = "n" * 300
for one, other in (("a", "b"), ("b", "a")):
    os.symlink(f"loop_{one}", folder / f"loop_{other}")
fill = '<fill><element set="all" at="0 0 0" radius="1 mm" density="2000 kg/m^3"/>{}</fill>'
move = '<move><verlet time-step="1 us" until="10"/></move>'
(folder / "includes.xml").write_text(f'<scene>\n<include file="{long}"/>\n<include file="loop_a"/>\n<include file="{"d/../" * 2000}x"/>\n{fill.format("")}{move}</scene>\n')
packings = "\n".join(f'<read-packing set="all" file="{name}" density="1 g/cm^3"/>' for name in (long, "loop_a", "loop_a/x"))
(folder / "files.xml").write_text(f"<scene>\n{fill.format(packings)}{move}</scene>\n")
(folder / "plain.xml").write_text(f"<scene>\n{fill.format('')}{move}</scene>\n")
for name, path in (("long", long), ("loop", "loop_a")):
    (folder / f"plugins_{name}.xml").write_text(f'<scene plugins="{path}">\n{fill.format("")}{move}</scene>\n')
(folder / "plugins_text.xml").write_text(f'<scene plugins="plain.xml">\n{fill.format("<mine/>")}{move}</scene>\n')
