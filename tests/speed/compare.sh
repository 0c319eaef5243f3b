#!/usr/bin/env bash
# The whole step of xml-cases/speed/bar.xml beside a plain scalar loop that does the same beams and nothing else, and beside
# the same bar of springs, in one go on one machine. It reports; it judges nothing. Usage: tests/speed/compare.sh [build folder]
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/release}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

"$build/bin/beadwork" run xml-cases/speed/bar.xml --out "$out/warm" --set steps=10 --quiet
run() { # deck, threads -> bond updates per second
  "$build/bin/beadwork" run "xml-cases/speed/$1.xml" --set packing="$out/warm/run.h5" --out "$out/run" --overwrite --threads "$2" --quiet
  grep -o '"bond_updates_per_second": [0-9.e+]*' "$out/run/summary.json" | cut -d' ' -f2
}
for k in 1 2 3 4 5; do
  for threads in 1 2; do
    for deck in stored springs; do run $deck $threads >>"$out/$deck-$threads"; done
  done
done
median() { sort -g "$out/$1" | sed -n 3p; }
plain=$("$build/bin/speed_beam_loops" --benchmark_filter=plain --benchmark_format=csv 2>/dev/null | awk -F, '/_median/ {print $NF}')
awk -v p="$plain" -v a="$(median stored-1)" -v b="$(median stored-2)" -v c="$(median springs-1)" -v d="$(median springs-2)" 'BEGIN {
  printf "plain scalar loop, one thread  %7.1f million bonds/s\n", p / 1e6
  printf "whole step, one thread         %7.1f   ratio %.2f\n", a / 1e6, a / p
  printf "whole step, two threads        %7.1f   ratio %.2f\n", b / 1e6, b / p
  printf "springs, one thread            %7.1f   %.2f of beams\n", c / 1e6, c / a
  printf "springs, two threads           %7.1f   %.2f of beams\n", d / 1e6, d / b
}'
