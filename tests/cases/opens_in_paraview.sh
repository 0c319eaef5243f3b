#!/usr/bin/env bash
# ParaView sees of a run what its file holds: elements, bonds and their state.   Usage: opens_in_paraview.sh SOURCE_FOLDER BEADWORK
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$2" run "$1/xml-cases/notched-bar/quick.xml" --out "$work/run" --threads 1 --quiet
/usr/bin/python3 "$1/tools/check-paraview.py" "$work/run"
