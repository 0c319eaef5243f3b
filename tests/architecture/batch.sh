#!/usr/bin/env bash
# beadwork batch: all combinations, a table, nothing done twice, interrupted runs go on, Slurm.   Usage: batch.sh SOURCE_FOLDER BEADWORK
set -euo pipefail
source=$1 beadwork=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
deck=$work/deck.xml
sed 's|until="2000"|until="${n}"|; s|<parameter name="v"|<parameter name="n" value="200"/>&|' "$source/xml-cases/two-elements/quick.xml" >"$deck"

fail() { echo "FAILED: $1"; cat "$work/output"; exit 1; }
expect() { # CODE COMMAND...
  local code=$1 got=0
  shift
  "$@" >"$work/output" 2>&1 || got=$?
  [ "$got" = "$code" ] || fail "exit code $got, not $code: $*"
}
rows() { grep -c "$1" "$work/$2/batch.csv" || true; }

echo "all combinations, each in a folder of its own"
sweep=("$beadwork" batch "$deck" --out "$work/sweep" --vary 'E=50 GPa,100 GPa' --vary 'v=0.5 mm/s,1 mm/s' --jobs 2)
expect 0 "${sweep[@]}"
[ "$(rows ',done,2,200,' sweep)" = 4 ] || fail "not four runs of 200 steps: $(cat "$work/sweep/batch.csv")"
[ -f "$work/sweep/E=100-GPa,v=0.5-mm-s/summary.json" ] || fail "no summary"

echo "what is done is left alone; another deck in its place is refused"
expect 0 "${sweep[@]}"
grep -q "4 of them done already" "$work/output" || fail "ran again"
expect 2 "${sweep[@]}" --set n=300
grep -q "another deck" "$work/output" || fail "no reason"

echo "a bad value is refused before anything runs"
expect 2 "$beadwork" batch "$deck" --out "$work/bad" --vary 'E=50 GPa,-1 GPa'
[ ! -e "$work/bad" ] || fail "something ran"
expect 2 "$beadwork" batch "$deck" --out "$work/bad" --vary E
expect 2 "$beadwork" batch "$deck" --out "$work/bad" --vary E=1,2 --vary E=3

echo "interrupted runs go on"
"$beadwork" batch "$deck" --out "$work/long" --vary 'E=50 GPa,100 GPa' --jobs 2 --set n=1000000000 >"$work/output" 2>&1 &
batch=$!
for _ in $(seq 600); do
  [ -f "$work/long/E=50-GPa/curves/force.csv" ] && [ -f "$work/long/E=100-GPa/curves/force.csv" ] && break
  sleep 0.1
done
sleep 0.5
kill -TERM $batch
got=0
wait $batch || got=$?
[ $got = 5 ] || fail "exit code $got, not 5"
told="$beadwork batch $deck --out $work/long --vary 'E=50 GPa,100 GPa' --jobs 2 --set n=1000000000"
grep -qF "go on with: $told" "$work/output" || fail "the batch does not say how to go on"
grep -qF "go on with: $told" "$work/long/E=50-GPa/run.log" || fail "the run does not say how its batch goes on: $(cat "$work/long/E=50-GPa/run.log")"
[ "$(rows ',interrupted,' long)" = 2 ] || fail "not interrupted: $(cat "$work/long/batch.csv")"
expect 0 "$beadwork" batch "$deck" --out "$work/long" --vary 'E=50 GPa,100 GPa' --set n=1
[ "$(rows ',done,' long)" = 2 ] || fail "not done: $(cat "$work/long/batch.csv")"
[ "$(rows ',done,2,1,' long)" = 0 ] || fail "begun anew instead of resumed"

echo "Slurm gets an array of jobs"
slurm=("$beadwork" batch "$deck" --out "$work/slurm" --vary 'E=50 GPa,100 GPa' --engine slurm)
expect 1 env PATH=/nowhere "${slurm[@]}"
grep -q "no sbatch here" "$work/output" || fail "no reason"
mkdir "$work/bin"
printf '#!/bin/bash\nfor task in 1 2; do SLURM_ARRAY_TASK_ID=$task bash "${@: -1}"; done\n' >"$work/bin/sbatch"
chmod +x "$work/bin/sbatch"
expect 0 env PATH="$work/bin:$PATH" "${slurm[@]}"
expect 0 "$beadwork" batch "$deck" --out "$work/slurm" --vary 'E=50 GPa,100 GPa'
grep -q "2 of them done already" "$work/output" || fail "the jobs did not run"
echo "passed"
