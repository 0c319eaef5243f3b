#!/usr/bin/env bash
# How long threads wait for one another, for docs/performance.md. First with a busy process per processor beside the run: all threads
# against one. Then on the machine as it is: all threads of this build against those of another build, if one is given. Runs alternate, and
# medians are told; nothing is judged. Usage: tests/speed/waiting.sh [build folder [other build folder]]
# PAIRS=9 takes more pairs, THREADS=4 fewer threads than there are processors, DECKS="tension/quick dcb/quick" other decks.
set -euo pipefail
cd "$(dirname "$0")/../.."
build=${1:-build/release} other=${2:-} pairs=${PAIRS:-5} threads=${THREADS:-$(nproc)} decks=${DECKS:-tension/quick dcb/quick two-elements/quick}
out=$(mktemp -d)
busy=()
end() {
  [ ${#busy[@]} = 0 ] || kill "${busy[@]}"
  rm -rf "$out"
}
trap end EXIT

seconds() { # build, threads, deck, options... -> seconds in the loop
  local program=$1/bin/beadwork number=$2 deck=$3 folder
  folder=$out/${1//\//-}  # another build may list its files otherwise
  shift 3
  "$program" run "$deck" --out "$folder" --overwrite --threads "$number" --quiet "$@"
  grep -o '"loop_seconds": [0-9.e+-]*' "$folder/summary.json" | cut -d' ' -f2
}
median() { sort -g "$1" | awk '{v[NR] = $1} END {print NR % 2 ? v[(NR + 1) / 2] : (v[NR / 2] + v[NR / 2 + 1]) / 2}'; }
tell() { # title, file of the first, file of the second
  awk -v title="$1" -v a="$(median "$2")" -v b="$(median "$3")" -v low="$(paste "$2" "$3" | awk '{print $2 / $1}' | sort -g | head -n 1)" \
    -v high="$(paste "$2" "$3" | awk '{print $2 / $1}' | sort -g | tail -n 1)" \
    'BEGIN {printf "%-72s %8.3g s %8.3g s   %.2f times (pairs %.2f to %.2f)\n", title, a, b, b / a, low, high}'
}
compare() { # title, command of the first, command of the second
  : >"$out/a" && : >"$out/b"
  for _ in $(seq "$pairs"); do
    $2 >>"$out/a"
    $3 >>"$out/b"
  done
  tell "$1" "$out/a" "$out/b"
}

"$build/bin/beadwork" run xml-cases/speed/bar.xml --out "$out/bar" --set steps=10 --quiet
stored="xml-cases/speed/stored.xml --set packing=$out/bar/run.h5"

echo "a busy process per processor beside it: one thread, $threads threads"
for processor in $(seq 0 $(($(nproc) - 1))); do
  taskset -c "$processor" bash -c 'while :; do :; done' &
  busy+=($!)
done
for deck in $decks; do
  compare "  $deck" "seconds $build 1 xml-cases/$deck.xml" "seconds $build $threads xml-cases/$deck.xml"
done
compare "  speed/stored" "seconds $build 1 $stored" "seconds $build $threads $stored"
kill "${busy[@]}"
busy=()

echo "the machine as it is: one thread, $threads threads"
for deck in $decks; do
  compare "  $deck" "seconds $build 1 xml-cases/$deck.xml" "seconds $build $threads xml-cases/$deck.xml"
done
compare "  speed/stored" "seconds $build 1 $stored" "seconds $build $threads $stored"

[ -n "$other" ] || exit 0
echo "the machine as it is, $threads threads: $other, $build"
for deck in $decks; do
  compare "  $deck" "seconds $other $threads xml-cases/$deck.xml" "seconds $build $threads xml-cases/$deck.xml"
done
compare "  speed/stored" "seconds $other $threads $stored" "seconds $build $threads $stored"
