#!/usr/bin/env bash
# The whole step of xml-cases/speed/heap.xml, counted in pairs within the skin, beside a plain scalar loop that does the same contacts
# and nothing else, in one go on one machine; and the share of a flowing heap's instructions that goes into looking for pairs (where
# valgrind is installed). It reports; it judges nothing. Usage: tests/speed/contacts.sh [build folder]
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/release}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

run() { # threads -> pairs per second
  "$build/bin/beadwork" run xml-cases/speed/heap.xml --set steps=300 --out "$out/run" --overwrite --threads "$1" --quiet
  /usr/bin/python3 - "$out/run/summary.json" <<'PY'
import json, sys
s = json.load(open(sys.argv[1]))
print(s["contacts"]["grains"] * s["steps"] / s["loop_seconds"])
PY
}
for k in 1 2 3 4 5; do
  for threads in 1 2; do run $threads >>"$out/$threads"; done
  "$build/bin/speed_contact_loops" --benchmark_filter=plain --benchmark_format=csv 2>/dev/null | awk -F, '/_median/ {print $NF}' >>"$out/plain"
done
median() { sort -g "$out/$1" | sed -n 3p; }
awk -v p="$(median plain)" -v a="$(median 1)" -v b="$(median 2)" 'BEGIN {
  printf "plain scalar loop, one thread  %7.1f million pairs/s\n", p / 1e6
  printf "whole step, one thread         %7.1f   ratio %.2f\n", a / 1e6, a / p
  printf "whole step, two threads        %7.1f   ratio %.2f\n", b / 1e6, b / p
}'
command -v valgrind >/dev/null || exit 0
count() { # steps -> instructions in all, and within the search
  BEADWORK_INSTRUCTIONS=baseline valgrind --tool=callgrind --callgrind-out-file="$out/grind" -q \
    "$build/bin/beadwork" run xml-cases/heap/quick.xml --set "end=$1" --out "$out/run" --overwrite --threads 1 --quiet >/dev/null 2>&1
  callgrind_annotate --inclusive=yes --threshold=100 "$out/grind" 2>/dev/null |
    awk '/PROGRAM TOTALS/ {gsub(",", "", $1); all = $1} /Contacts::search/ && !s {gsub(",", "", $1); s = $1} /RunLoop|Run::steps|Run::all/ && !r {gsub(",", "", $1); r = $1} END {print all, s + 0}'
}
read -r early early_search < <(count "20 ms")
read -r late late_search < <(count "60 ms")
awk -v a="$early" -v b="$late" -v s="$early_search" -v t="$late_search" 'BEGIN {
  printf "a heap that flows: %.1f %% of the instructions of its steps look for pairs\n", 100 * (t - s) / (b - a)
}'
