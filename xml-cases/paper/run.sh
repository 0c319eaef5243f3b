#!/usr/bin/env bash
# Runs the single-fibre and multi-fibre studies of the paper at its size: xml-cases/paper/run.sh [OUT] [SEEDS] [options of beadwork batch]
# Give the same command again to go on. OUT/runs/batch.csv is the table, OUT/runs/report.html the report, OUT/figures.md what is held
# against the paper. --jobs, --threads and the like are for all batches; a --set for the runs alone stands in RUNS, as in RUNS="--set v=1".
set -uo pipefail
here=$(cd "$(dirname "$0")" && pwd)
beadwork=${BEADWORK:-$here/../../build/release/bin/beadwork}
out=${1:-out/paper}
seeds=${2:-1,2,3}
shift $(($# < 2 ? $# : 2))
mkdir -p "$out" && out=$(cd "$out" && pwd) || exit 1
worst=0
batch() { "$beadwork" batch --keep-going "$@" || worst=$?; [ "$worst" != 5 ] || exit 5; }
batch "$here"/packings/{coarse,intermediate,fine,vf10,vf30,vf40}.xml --vary seed="$seeds" --out "$out/packings" "$@"
batch "$here"/packings/stage-*.xml --out "$out/filling" "$@"
# shellcheck disable=SC2086
batch "$here"/{coarse,intermediate,fine,vf}*.xml --vary seed="$seeds" --set packings="$out/packings" --out "$out/runs" ${RUNS:-} "$@"
"$beadwork" report "$out/runs" || worst=$?
/usr/bin/python3 "$here/figures.py" "$out/runs" >"$out/figures.md" || worst=$?
echo "$out/figures.md"
exit "$worst"
