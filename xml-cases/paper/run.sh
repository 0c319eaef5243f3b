#!/usr/bin/env bash
# Runs the paper as one study: xml-cases/paper/run.sh [OUT] [SEEDS] [options of beadwork batch]
# SEEDS is how many packings there are of each, 1; of the large cells two at most. Give the same command again to go on.
# OUT/report.html has what is claimed and the figures beside what was found; OUT/figures.md more figures of the composites.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
beadwork=${BEADWORK:-$here/../../build/release/bin/beadwork}
out=${1:-out/paper}
seeds=${2:-1}
shift $(($# < 2 ? $# : 2))
"$beadwork" batch "$here/study.xml" --out "$out" --set seeds="$seeds" --keep-going "$@"
worst=$?
[ "$worst" != 5 ] || exit 5
"$beadwork" report "$out" || worst=$?
/usr/bin/python3 "$here/figures.py" "$out/single-fibre" "$out/many-fibres" --rows "$out/figures.csv" >"$out/figures.md" || worst=$?
echo "$out/figures.md"
exit "$worst"
