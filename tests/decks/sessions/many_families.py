"""A row of elements, each a set of its own, each bond a family of its own: a deck, or the force that its run ends with.
Usage: many_families.py deck COUNT FILE
       many_families.py force COUNT RUN"""
import csv
import math
import sys
from pathlib import Path

count, place = int(sys.argv[2]), Path(sys.argv[3])
if sys.argv[1] == "force":
    rows = list(csv.reader(open(place / "curves/force.csv", encoding="utf-8")))
    off = float(rows[-1][rows[0].index("force [N]")]) / (1e9 * math.pi * 0.25e-6 * 1e-6 / (2e-3 * (count - 1))) - 1
    print(f"the force is off E S/L times the elongation by {off:.2g}")
    sys.exit(not abs(off) < 1e-6)
elements = "".join(f'<element set="e{k}" at="{2 * k} 0 0 mm" radius="1 mm" density="1 g/cm^3"/>\n' for k in range(count))
bonds = "".join(f'<cohesive-beam name="b{k}" between="e{k - 1} e{k}" young="1 GPa" radius-ratio="0.5"/>\n' for k in range(1, count))
place.write_text(f"""<scene><fill>{elements}</fill><bond>{bonds}</bond>
<load><hold set="e0" axes="x y z rx ry rz"/><pull set="e{count - 1}" axis="x" velocity="1 um/s"/></load>
<move><static increment="1 um" until="1 um"/></move>
<watch><force-curve of="e{count - 1}" axis="x" every="1"/></watch></scene>""")
