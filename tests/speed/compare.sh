#!/usr/bin/env bash
# The whole step of xml-cases/speed/bar.xml beside a plain scalar loop that does the same beams and nothing else, in one
# go on one machine. It reports; it judges nothing. Usage: tests/speed/compare.sh [build folder]
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/release}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

"$build/bin/beadwork" run xml-cases/speed/bar.xml --out "$out/warm" --set steps=10 --quiet
rate() { # threads -> median of 5 of bond updates per second, in millions
  for k in 1 2 3 4 5; do
    "$build/bin/beadwork" run xml-cases/speed/stored.xml --set packing="$out/warm/run.h5" --out "$out/$1-$k" --threads "$1" --quiet
    grep -o '"bond_updates_per_second": [0-9.e+]*' "$out/$1-$k/summary.json" | cut -d' ' -f2
  done | sort -g | sed -n 3p
}
plain=$("$build/bin/speed_beam_loops" --benchmark_filter=plain --benchmark_format=csv 2>/dev/null | awk -F, '/_median/ {print $NF}')
one=$(rate 1)
two=$(rate 2)
awk -v p="$plain" -v a="$one" -v b="$two" 'BEGIN {
  printf "plain scalar loop, one thread  %7.1f million bonds/s\n", p / 1e6
  printf "whole step, one thread         %7.1f   ratio %.2f\n", a / 1e6, a / p
  printf "whole step, two threads        %7.1f   ratio %.2f\n", b / 1e6, b / p
}'
