#!/usr/bin/python3
"""The paper as one study, quick: all runs end, each claim has a number, each figure is on the page.   Usage: paper_study.py SOURCE BEADWORK"""
import csv
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
from pathlib import Path

SURE = {  # hold in a slice that is pulled fast, too
    "D5 slope", "D5 peak", "S3 slope", "S8", "M4 .1", "M6 .1, 2", "M6 .3, 2",
}


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"FAILED: {' '.join(command)}: exit code {done.returncode}\n{done.stdout[-4000:]}{done.stderr[-4000:]}")


def rows_of(file):
    with open(file, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


def main():
    paper, beadwork = Path(sys.argv[1]) / "xml-cases/paper", sys.argv[2]
    stated = [xml.etree.ElementTree.parse(file) for file in sorted((paper / "claims").glob("*.xml"))]
    claimed = [each.get("name") for deck in stated for each in deck.iter("claim")]
    figures = [each.get("name") for deck in stated for each in deck.iter("figure")]
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        run(beadwork, "batch", str(paper / "study.xml"), "--out", str(out), "--set", "scale=quick", "--jobs", "2", "--threads", "1")
        run(beadwork, "report", str(out))
        runs, found = rows_of(out / "batch.csv"), {row["claim"]: row for row in rows_of(out / "claims.csv")}
        page = (out / "report.html").read_text(encoding="utf-8")
    wrong = [f"{row['run']}: {row['status']}" for row in runs if row["status"] != "done"]
    of_the_paper = [row for row in runs if row["run"].split("/")[0] in ("calibrations", "beam", "single-fibre", "many-fibres")]
    if len(of_the_paper) != 22:
        wrong.append(f"{len(of_the_paper)} runs, not 22")
    for name in claimed:
        verdict = found[name]["verdict"] if name in found else "missing"
        if verdict not in ("in", "out", "no band", "not reached") or (name in SURE and verdict != "in"):
            wrong.append(f"claim {name}: {verdict} {found.get(name)}")
        if f"<th>{name}</th>" not in page:
            wrong.append(f"claim {name} is not on the page")
    wrong += [f"figure {name} is not on the page" for name in figures if f"<h3>{name}: " not in page]
    wrong += [word for word in ("yet.</p>", "cannot be shown") if word in page]
    print("\n".join(wrong) or f"{len(runs)} runs, {len(claimed)} claims, {len(figures)} figures")
    return len(wrong) > 0


sys.exit(main())
