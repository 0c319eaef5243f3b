#!/usr/bin/env bash
# Runs the single-fibre and multi-fibre studies of the paper at its size: xml-cases/paper/run.sh [OUT] [SEEDS] [options of beadwork batch]
# SEEDS are those of the single fibre, '1 2 3'; the large cells have the first two of them. Give the same command again to go on.
# OUT/batch.csv is the table, OUT/report.html the report, OUT/figures.md what is held against the paper.
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
beadwork=${BEADWORK:-$here/../../build/release/bin/beadwork}
out=${1:-out/paper}
seeds=${2:-1 2 3}
shift $(($# < 2 ? $# : 2))
"$beadwork" batch "$here/study.xml" --out "$out" --set seeds="$seeds" --set cells="$(echo "$seeds" | cut -d' ' -f1,2)" --keep-going "$@"
worst=$?
[ "$worst" != 5 ] || exit 5
"$beadwork" report "$out" || worst=$?
/usr/bin/python3 "$here/figures.py" "$out/single-fibre" "$out/many-fibres" --rows "$out/figures.csv" >"$out/figures.md" || worst=$?
echo "$out/figures.md"
exit "$worst"
