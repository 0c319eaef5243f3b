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

says() { grep -qF -- "$1" "$work/output" || fail "no \"$1\""; }
column() { # NAME FOLDER -> its values, a line each
  /usr/bin/python3 -c 'import csv, sys; print("\n".join(row[sys.argv[1]] for row in csv.DictReader(open(sys.argv[2] + "/batch.csv"))))' "$1" "$work/$2"
}

echo "the table has what the runs have found"
[ "$(column 'force: final displacement [m]' sweep | sort -u | wc -l)" -ge 2 ] || fail "no displacements: $(cat "$work/sweep/batch.csv")"
for run in 'E=50-GPa,v=0.5-mm-s' 'E=100-GPa,v=1-mm-s'; do
  /usr/bin/python3 - "$work/sweep" "$run" <<'END' || fail "the table and the run differ"
import csv, json, sys
folder, run = sys.argv[1:]
row = next(r for r in csv.DictReader(open(f"{folder}/batch.csv")) if r["run"] == run)
names, *rows = csv.reader(open(f"{folder}/{run}/curves/force.csv"))
at = {name.split(" ")[0]: k for k, name in enumerate(names)}
largest = max((float(r[at["force"]]) for r in rows), key=abs)
summary = json.load(open(f"{folder}/{run}/summary.json"))
assert float(row["force: largest force [N]"]) == largest != 0, (row, largest)
assert float(row["force: final displacement [m]"]) == float(rows[-1][at["displacement"]]) != 0
assert float(row["energy: work [J]"]) == summary["energy"]["work"] != 0
assert float(row["energy: residual [J]"]) == summary["energy"]["residual"]
END
done

echo "a report lays the curves of the runs over one another"
expect 0 "$beadwork" report "$work/sweep"
for label in 'E = 50 GPa, v = 0.5 mm/s' 'E = 100 GPa, v = 1 mm/s'; do
  [ "$(grep -o "$label" "$work/sweep/report.html" | wc -l)" -ge 1 ] || fail "no curve of $label"
done
says report.html

echo "all bad values of all runs are told at once, and nothing runs"
expect 2 "$beadwork" batch "$deck" --out "$work/bad" --vary 'E=50 GPa,-1 GPa,-2 GPa' --vary 'v=1 mm/s,1 kg'
says 'got "-1 GPa"'
says 'got "-2 GPa"'
says 'in 2 runs: E=-1 GPa, v=1 mm/s; E=-1 GPa, v=1 kg'
says 'in 3 runs: E=50 GPa, v=1 kg; E=-1 GPa, v=1 kg; E=-2 GPa, v=1 kg'
says '5 of 6 runs cannot begin'
[ ! -e "$work/bad" ] || fail "something ran"
expect 2 "$beadwork" batch "$deck" --out "$work/bad" --vary 'E=50 GPa,-1 GPa' --keep-going
[ "$(rows ',done,2,200,' bad)" = 1 ] && [ "$(rows ',refused,' bad)" = 1 ] || fail "the good one did not run: $(cat "$work/bad/batch.csv")"
[ ! -e "$work/bad/E=-1-GPa" ] || fail "a bad one ran"

echo "names of any length"
long=$(printf '0%.0s' $(seq 300))
expect 0 "$beadwork" batch "$deck" --out "$work/names" --vary "E=50.${long}1 GPa,50.${long}2 GPa" --set n=2
[ "$(rows ',done,2,2,' names)" = 2 ] || fail "not two runs"
for run in "$work"/names/*/; do [ "$(basename "$run" | wc -c)" -le 201 ] || fail "a long name: $run"; done
[ "$(column E names | head -n 1)" = "50.${long}1 GPa" ] || fail "the table lacks the value"
expect 0 "$beadwork" batch "$deck" --out "$work/names" --vary "E=50.${long}1 GPa,50.${long}2 GPa" --set n=2
says "2 of them done already"

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

echo "whoever kills the batch leaves no orphans, and who begins anew beside them waits"
begin=("$beadwork" batch "$deck" --out "$work/orphans" --vary 'E=50 GPa,100 GPa' --jobs 2 --set n=1000000000)
"${begin[@]}" >"$work/output" 2>&1 &
batch=$!
for _ in $(seq 600); do
  [ -s "$work/orphans/E=50-GPa/curves/force.csv" ] && [ -s "$work/orphans/E=100-GPa/curves/force.csv" ] && break
  sleep 0.1
done
expect 2 "${begin[@]}"
says "a batch is running"
says "process $batch"
children=$(pgrep -P $batch)
for child in $children; do kill -STOP "$child"; done # orphans that take their time
kill -KILL $batch
wait $batch || true
"${begin[@]}" >"$work/output" 2>&1 &
again=$!
for _ in $(seq 600); do
  [ "$(grep -c "is at it still and is waited for" "$work/output" || true)" = 2 ] && break
  sleep 0.1
done
[ "$(grep -c "is at it still and is waited for" "$work/output")" = 2 ] || fail "does not say that it waits"
for child in $children; do
  says "process $child"
  kill -CONT "$child"
done
for _ in $(seq 600); do
  [ "$(pgrep -c -P $again || true)" = 2 ] && break
  sleep 0.1
done
# One that has ended and that nobody has asked about yet (Z) does not go on.
for child in $children; do ! grep -sqv ') Z ' "/proc/$child/stat" || fail "an orphan goes on"; done
kill -HUP $again
got=0
wait $again || got=$?
[ $got = 5 ] || fail "exit code $got, not 5"
! grep -q "exit code" "$work/output" || fail "a run is called failed"
[ "$(rows ',interrupted,' orphans)" = 2 ] || fail "not interrupted: $(cat "$work/orphans/batch.csv")"
grep -q "resumed at step" "$work/orphans/E=50-GPa/run.log" || fail "did not go on where the orphan was"

echo "a run names itself"
sed 's|<force-curve |&at="1000 s" |' "$deck" >"$work/vain.xml"
expect 0 "$beadwork" batch "$work/vain.xml" --out "$work/vain" --vary 'E=50 GPa,100 GPa' --jobs 2
for run in E=50-GPa E=100-GPa; do grep -q "^\[$run\] warning: " "$work/output" || fail "who speaks? $run"; done

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

echo "no value becomes a command"
trap=$'50 GPa\ntouch hacked1\n' && odd="\$(touch $work/hacked2)\`touch $work/hacked3\`'; touch $work/hacked4; '\""
cat >"$work/bin/sbatch" <<'END'
#!/bin/bash
for task in $(seq "$(wc -l <"$(dirname "${@: -1}")/batch.commands")"); do SLURM_ARRAY_TASK_ID=$task bash "${@: -1}" || echo "task $task: $?"; done
END
sed 's|<scene name="[^"]*"|<scene name="${title}"|; s|<parameter name="v"|<parameter name="title" value="x"/>&|' "$deck" >"$work/titled.xml"
hacked=("$beadwork" batch "$work/titled.xml" --vary "title=a${trap}b,$odd" --set n=3)
(cd "$work" && expect 0 env PATH="$work/bin:$PATH" "${hacked[@]}" --out "$work/hack" --engine slurm)
[ "$(wc -l <"$work/hack/batch.commands")" = 2 ] || fail "not a line a run: $(cat "$work/hack/batch.commands")"
[ -z "$(find "$work" -name 'hacked*')" ] || fail "a value was run as a command"
expect 0 "${hacked[@]}" --out "$work/hack"
says "2 of them done already"
echo "passed"
