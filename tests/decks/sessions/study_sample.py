"""Points fill the ranges as their method says.   Usage: study_sample.py SOBOL LATIN"""
import csv
import math
import sys
from pathlib import Path


def points(folder):
    with open(Path(folder) / "batch.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 8 and all(row["status"] == "done" for row in rows)
    assert all(row["young"].endswith(" GPa") and row["v"].endswith(" mm/s") for row in rows), rows[0]
    number = lambda text: float(text.split()[0])  # noqa: E731
    return [(math.log10(number(row["young"])) / 2, number(row["v"]) - 1) for row in rows]


sobol = points(sys.argv[1])
# Joe and Kuo: 1/2 1/2, 3/4 1/4, 1/4 3/4, 3/8 3/8, 7/8 7/8, 5/8 1/8, 1/8 5/8, 3/16 5/16
expected = [(4, 4), (6, 2), (2, 6), (3, 3), (7, 7), (5, 1), (1, 5), (1.5, 2.5)]
for (x, y), (a, b) in zip(sobol, expected, strict=True):
    assert abs(x - a / 8) < 1e-12 and abs(y - b / 8) < 1e-12, (sobol, expected)
latin = points(sys.argv[2])
for axis in range(2):
    assert sorted(int(8 * point[axis]) for point in latin) == list(range(8)), latin
assert [int(8 * x) for x, _ in latin] != [int(8 * y) for _, y in latin], latin
