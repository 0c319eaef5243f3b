#!/usr/bin/env bash
# How time and memory grow with the number of elements: the lattice of xml-cases/speed/lattice.xml in four sizes, the packing
# of bar.xml in as many as are named. It reports; it judges nothing. A line is the run with the
# median rate of three; besides the loop there are filling, the time step, and checkpoints, of which a run of more than a minute has two.
# Usage: tests/speed/scale.sh [build folder [counts of packed elements ...]]
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/release}
shift || true
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

run() { # threads, deck and settings -> seconds in all, seconds in the loop, bond updates per second, peak kB
  local threads=$1
  shift
  /usr/bin/time -f %M -o "$out/peak" "$build/bin/beadwork" run "$@" --threads "$threads" --out "$out/run" --overwrite --quiet < /dev/null
  number() { grep -o "\"$1\": [0-9.e+]*" "$out/run/summary.json" | cut -d' ' -f2; }
  echo "$(number wall_seconds) $(number loop_seconds) $(number bond_updates_per_second) $(tail -n 1 "$out/peak")"
}

printf '%9s %7s  %16s  %18s  %10s\n' elements threads 'ns a bond-step' 's besides the loop' 'peak MB'
while read -r nx ny nz steps; do
  for threads in 1 2; do
    for k in 1 2 3; do
      run "$threads" xml-cases/speed/lattice.xml --set nx="$nx" --set ny="$ny" --set nz="$nz" --set steps="$steps"
    done | sort -g -k3 | sed -n 2p | awk -v n=$((nx * ny * nz)) -v t="$threads" '{printf "%9d %7d  %16.1f  %18.1f  %10.0f\n", n, t, 1e9 / $3, $1 - $2, $4 / 1000}'
  done
done <<< '40 40 25 500
100 50 20 200
200 100 50 30
200 200 100 8'

for count in "$@"; do
  size=$(awk -v n="$count" 'BEGIN {printf "%.6f", (n / 40000) ^ (1 / 3)}')
  for threads in 1 2; do
    run "$threads" xml-cases/speed/bar.xml --set count="$count" --set size="$size" --set steps=1 > "$out/figures"
    grep -o '"seconds":[0-9.]*\|"seconds": [0-9.]*' "$out/run/summary.json" | tail -n 1 |
      awk -F: -v n="$count" -v t="$threads" '{printf "packing of %8d elements, %d threads: %7.1f s, %.1f us an element\n", n, t, $2, 1e6 * $2 / n}'
  done
done
