#!/usr/bin/env bash
# Runs the single-fibre and multi-fibre studies of the paper at its size: xml-cases/paper/run.sh [OUT] [SEEDS] [options of beadwork batch]
# Give the same command again to go on. OUT/runs/batch.csv is the table, OUT/runs/report.html the report, OUT/figures.md what is held
# against the paper.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
beadwork=${BEADWORK:-$here/../../build/release/bin/beadwork}
out=${1:-out/paper}
seeds=${2:-1,2,3}
shift $(($# < 2 ? $# : 2))
mkdir -p "$out"
out=$(cd "$out" && pwd)
"$beadwork" batch "$here"/packings/{coarse,intermediate,fine,vf10,vf30,vf40}.xml --vary seed="$seeds" --out "$out/packings" "$@"
"$beadwork" batch "$here"/packings/stage-*.xml --out "$out/filling" "$@"
decks=("$here"/{coarse,intermediate,fine,vf}*.xml)
"$beadwork" batch "${decks[@]}" --vary seed="$seeds" --set packings="$out/packings" --out "$out/runs" --keep-going "$@"
"$beadwork" report "$out/runs"
/usr/bin/python3 "$here/figures.py" "$out/runs" >"$out/figures.md"
echo "$out/figures.md"
