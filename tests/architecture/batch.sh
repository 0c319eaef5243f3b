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
assert row["quality: verdict"] == summary["quality"]["verdict"] != "", row
assert float(row["quality: free_motion [m]"]) == summary["quality"]["free_motion"], row
END
done

echo "several decks stand in one table, each under its name"
cp "$deck" "$work/other.xml"
expect 0 "$beadwork" batch "$deck" "$work/other.xml" --vary 'v=0.5 mm/s,1 mm/s' --out "$work/both"
[ "$(column deck both | sort | uniq -c | tr -s ' ' | tr '\n' ';')" = " 2 deck; 2 other;" ] || fail "$(cat "$work/both/batch.csv")"
[ -f "$work/both/deck=other,v=1-mm-s/summary.json" ] || fail "no run of the second deck"
mkdir "$work/same" && cp "$deck" "$work/same/deck.xml"
expect 2 "$beadwork" batch "$deck" "$work/same/deck.xml" --out "$work/twins"
says "decks, whose names"

echo "a report lays the curves of the runs over one another"
expect 0 "$beadwork" report "$work/sweep"
for label in 'E = 50 GPa, v = 0.5 mm/s' 'E = 100 GPa, v = 1 mm/s'; do
  [ "$(grep -o "$label" "$work/sweep/report.html" | wc -l)" -ge 1 ] || fail "no curve of $label"
done
says report.html
curves=$(grep -o '<figure class="chart">.*' "$work/sweep/report.html" | grep -o '<path class="line' | wc -l)
charts=$(grep -o '<figure class="chart">' "$work/sweep/report.html" | wc -l)
[ "$charts" -ge 1 ] && [ "$curves" = $((4 * charts)) ] || fail "not four curves a chart: $curves in $charts"
expect 0 "$beadwork" report "$work/sweep"

echo "a run whose data files have changed is run again"
printf 'r [mm],x [mm],y [mm],z [mm]\n1,0,0,0\n1,2,0,0\n' >"$work/balls.csv"
cp "$work/balls.csv" "$work/others.csv"
data=("$beadwork" batch "$source/tests/decks/sessions/packing_tables.xml" --out "$work/data" --vary "table=$work/balls.csv,$work/others.csv")
expect 0 "${data[@]}"
expect 0 "${data[@]}"
says "2 of them done already"
echo '1,4,0,0' >>"$work/balls.csv"
expect 0 "${data[@]}"
says "1 of them done already"
says "1 of them were done with other data files"
[ "$(column elements data)" = $'3\n2' ] || fail "not run again with three elements: $(cat "$work/data/batch.csv")"

echo "files of somebody else are left alone"
for file in batch.csv batch.jobs batch.slurm batch.files; do
  mkdir -p "$work/mine-$file"
  echo mine >"$work/mine-$file/$file"
  engine=local
  case $file in batch.jobs | batch.slurm) engine=slurm ;; esac
  expect 2 "$beadwork" batch "$deck" --out "$work/mine-$file" --vary 'E=50 GPa' --engine $engine
  says "mine-$file/$file' is there already, and no batch made it"
  says "choose another folder"
  [ "$(cat "$work/mine-$file/$file")" = mine ] || fail "$file is gone"
done
mkdir "$work/page"
expect 0 "$beadwork" batch "$deck" --out "$work/page" --vary 'E=50 GPa'
echo mine >"$work/page/report.html"
expect 2 "$beadwork" report "$work/page"
[ "$(cat "$work/page/report.html")" = mine ] || fail "report.html is gone"

echo "a place where no folder can be"
ln -s loop "$work/loop"
expect 2 "$beadwork" batch "$deck" --out "$work/loop" --vary 'E=50 GPa'
says "cannot be the folder of a batch: "
expect 2 "$beadwork" batch "$deck" --out "$deck" --vary 'E=50 GPa'
says "is a file"

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

echo "the table is text, whatever a value is"
expect 2 "$beadwork" batch "$deck" --out "$work/bytes" --vary $'E=50 GPa,\xff\x1b' --keep-going
iconv -f utf-8 -t utf-8 "$work/bytes/batch.csv" >/dev/null || fail "no UTF-8"
! grep -q $'\x1b' "$work/bytes/batch.csv" || fail "a control character"
[ "$(rows ',done,2,200,' bytes)" = 1 ] || fail "the good one did not run"

echo "values whose folders would have one name are told apart before anything runs"
expect 2 "$beadwork" batch "$deck" --out "$work/twins" --vary 'E=50 GPa,50-GPa'
says "the runs with 'E=50 GPa' and with E=50-GPa would write the same folder"
[ ! -e "$work/twins" ] || fail "something was written"

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
has_gone_on() { [ "$(cat "$work/long/$1/curves/force.csv" 2>/dev/null | wc -l)" -gt 3 ]; } # to its third look at least
for _ in $(seq 600); do
  has_gone_on E=50-GPa && has_gone_on E=100-GPa && break
  sleep 0.1
done
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

echo "what the machine stopped goes on, what physics stopped begins anew"
full=("$beadwork" batch "$deck" --out "$work/full" --vary 'E=50 GPa' --set n=100000)
expect 1 bash -c 'ulimit -f 98; exec "$@"' limited "${full[@]}"
[ "$(rows ',failed,' full)" = 1 ] && [ -f "$work/full/E=50-GPa/checkpoint.h5" ] || fail "did not fail: $(cat "$work/full/batch.csv")"
grep -q '"exit_code": 1' "$work/full/E=50-GPa/summary.json" || fail "does not say by whose fault"
cp -r "$work/full" "$work/full-slurm"
expect 0 "${full[@]}"
grep -q "resumed at step" "$work/full/E=50-GPa/run.log" || fail "begun anew instead of resumed"
cat >"$work/wild.xml" <<'END'
<scene name="wild">
  <parameter name="E" value="100 GPa"/>
  <fill>
    <element set="left"  at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="right" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
  </fill>
  <bond><cohesive-beam name="beam" between="left right" young="${E}" radius-ratio="0.5"/></bond>
  <load><hold set="left"/><initial-velocity set="right" velocity="1 0 0 m/s"/></load>
  <stage name="calm"><move><verlet until="10"/></move></stage>
  <stage name="wild"><move><verlet time-step="1 ms" until="100000"/></move></stage>
</scene>
END
wild=("$beadwork" batch "$work/wild.xml" --out "$work/wild" --vary 'E=50 GPa')
for again in 1 2; do
  expect 3 "${wild[@]}"
  [ -f "$work/wild/E=50-GPa/checkpoint.h5" ] || fail "no checkpoint to leave aside"
  ! grep -q "resumed at step" "$work/wild/E=50-GPa/run.log" || fail "went on to fail again, time $again"
done

echo "rows of runs that have ended are kept, and no run is left to itself when the batch fails"
kept=("$beadwork" batch "$deck" --out "$work/kept" --vary 'n=10,1000000000,1000000001' --jobs 2)
"${kept[@]}" >"$work/output" 2>&1 &
batch=$!
for _ in $(seq 600); do
  [ -s "$work/kept/n=1000000000/curves/force.csv" ] && [ -s "$work/kept/n=1000000001/curves/force.csv" ] && break
  sleep 0.1
done
rm "$work/kept/n=10/summary.json"
first=$(pgrep -P $batch -f n=1000000000) second=$(pgrep -P $batch -f n=1000000001)
kill -TERM "$first"
for _ in $(seq 600); do [ "$(rows ',interrupted,' kept)" = 1 ] && break; sleep 0.1; done
[ "$(rows ',done,2,10,' kept)" = 1 ] && [ "$(rows ',interrupted,' kept)" = 1 ] || fail "a row is gone: $(cat "$work/kept/batch.csv")"
kill -TERM $batch
wait $batch || true
"${kept[@]}" >"$work/output" 2>&1 &
batch=$!
for _ in $(seq 600); do [ "$(grep -l "resumed at step" "$work"/kept/n=100000000?/run.log | wc -l)" = 2 ] && break; sleep 0.1; done
first=$(pgrep -P $batch -f n=1000000000) second=$(pgrep -P $batch -f n=1000000001)
mkdir "$work/kept/batch.csv.part" # so that the table cannot be written
kill -STOP "$second"
kill -TERM "$first"
sleep 2
kill -0 $batch || fail "the batch has gone and left a run"
kill -CONT "$second"
got=0
wait $batch || got=$?
[ $got = 1 ] || fail "exit code $got, not 1"
says "batch.csv.part"
grep -q '"status": "interrupted"' "$work/kept/n=1000000001/summary.json" || fail "the other was not asked to stop"

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
  [ "$(grep -c "is still writing this run; waiting" "$work/output" || true)" = 2 ] && break
  sleep 0.1
done
[ "$(grep -c "is still writing this run; waiting" "$work/output")" = 2 ] || fail "does not say that it waits"
for child in $children; do
  says "process $child"
  kill -CONT "$child"
done
for _ in $(seq 600); do
  grep -qs "resumed at step" "$work/orphans/E=50-GPa/run.log" && grep -qs "resumed at step" "$work/orphans/E=100-GPa/run.log" && break
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

echo "runs that are asked to stop while they start are interrupted, not failed"
for pause in 0 0.004 0.008 0.012 0.016 0.02 0.03 0.04 0.06 0.1; do
  "$beadwork" batch "$deck" --out "$work/starts" --vary 'E=50 GPa,100 GPa' --jobs 2 --set n=1000000000 >"$work/output" 2>&1 &
  batch=$!
  for _ in $(seq 2000); do pgrep -P $batch >/dev/null && break; sleep 0.005; done
  sleep $pause
  kill -TERM $batch
  got=0
  wait $batch || got=$?
  [ $got = 5 ] || fail "exit code $got, not 5, after $pause s"
done

echo "a run names itself"
sed 's|<force-curve |&at="1000 s" |' "$deck" >"$work/vain.xml"
expect 0 "$beadwork" batch "$work/vain.xml" --out "$work/vain" --vary 'E=50 GPa,100 GPa' --jobs 2
for run in E=50-GPa E=100-GPa; do grep -q "^\[$run\] warning: " "$work/output" || fail "who speaks? $run"; done

echo "Slurm's jobs do the same, go on and begin anew as processes of this machine do" # against a real one: engines.sh
expect 1 env PATH=/nowhere "$beadwork" batch "$deck" --out "$work/slurm" --vary 'E=50 GPa,100 GPa' --engine slurm
says "there is no scontrol here"
mkdir "$work/bin"
# One that does all at once, and whose queue is always empty.
cat >"$work/bin/sbatch" <<END
#!/bin/bash
for word; do case \$word in --array=0-*) last=\${word#--array=0-} ;; esac; done
cat >"$work/script"
for task in \$(seq 0 "\${last%%%*}"); do SLURM_ARRAY_JOB_ID=17 SLURM_ARRAY_TASK_ID=\$task bash "$work/script"; done
echo 17
END
printf '#!/bin/bash\n' >"$work/bin/squeue"
printf '#!/bin/bash\necho "MaxArraySize = 1001"\n' >"$work/bin/scontrol"
chmod +x "$work"/bin/*
in_slurm() { # CODE COMMAND...
  local code=$1
  shift
  expect "$code" env PATH="$work/bin:$PATH" "$@" --engine slurm
}
in_slurm 0 "$beadwork" batch "$deck" --out "$work/slurm" --vary 'E=50 GPa,100 GPa'
says "E=50-GPa: done"
[ "$(rows ',done,2,200,' slurm)" = 2 ] || fail "not done: $(cat "$work/slurm/batch.csv")"
in_slurm 0 "$beadwork" batch "$deck" --out "$work/full-slurm" --vary 'E=50 GPa' --set n=100000
grep -q "resumed at step" "$work/full-slurm/E=50-GPa/run.log" || fail "begun anew instead of resumed"
in_slurm 3 "${wild[@]}"
says "E=50-GPa: exit code 3, see"
! grep -q "resumed at step" "$work/wild/E=50-GPa/run.log" || fail "went on to fail again"

echo "decks that were refused are not forgotten when others are submitted"
sed 's|<scene |<scene plugins="${library}" |; s|<parameter name="v"|<parameter name="library" value="x"/>&|' "$deck" >"$work/library.xml"
mkdir "$work/libraries"
in_slurm 4 "$beadwork" batch "$work/library.xml" --out "$work/refused" --vary "library=$work/libraries,$work/none.so" --keep-going
[ "$(rows ',done,' refused)" = 1 ] || fail "the other has not run: $(cat "$work/refused/batch.csv")"

echo "no value becomes a command"
trap=$'50 GPa\ntouch hacked1\n' && odd="\$(touch $work/hacked2)\`touch $work/hacked3\`'; touch $work/hacked4; '\""
sed 's|<scene name="[^"]*"|<scene name="${title}"|; s|<parameter name="v"|<parameter name="title" value="x"/>&|' "$deck" >"$work/titled.xml"
hacked=("$beadwork" batch "$work/titled.xml" --vary "title=a${trap}b,$odd" --set n=3)
(cd "$work" && in_slurm 0 "${hacked[@]}" --out "$work/hack")
[ "$(grep -c '^[0-9]*) exec ' "$work/script")" = 2 ] || fail "not a line a run: $(cat "$work/script")"
[ -z "$(find "$work" -name 'hacked*')" ] || fail "a value was run as a command"
expect 0 "${hacked[@]}" --out "$work/hack"
says "2 of them done already"
echo "passed"
