#!/usr/bin/env bash
# One contract for all engines of `beadwork batch`: what is needed comes first, a failure stops nobody else, whoever is
# killed loses nothing, nothing is done twice, and the tables are the same.   Usage: engines.sh SOURCE_FOLDER BEADWORK local|slurm
# For slurm it starts one of its own; where there is none it is skipped (exit code 77).
set -euo pipefail
source=$1 beadwork=$2 engine=$3
. "$source/tests/support/slurm_here.sh"
work=$(mktemp -d)
followers=() # processes that this test has started
clean() {
  local process
  for process in "${followers[@]}"; do kill -KILL "$process" 2>/dev/null || true; done
  stop_slurm
  rm -rf "$work"
}
trap clean EXIT

if [ "$engine" = slurm ]; then
  # Three tasks an array at most: larger sweeps are cut.
  start_slurm "$work/daemons" 3 >"$work/output" 2>&1 || { echo "skipped: no Slurm can be started here"; cat "$work/output"; exit 77; }
fi

fail() { echo "FAILED ($engine): $1"; cat "$work/output"; exit 1; }
expect() { # CODE COMMAND...
  local code=$1 got=0
  shift
  "$@" >"$work/output" 2>&1 || got=$?
  [ "$got" = "$code" ] || fail "exit code $got, not $code: $*"
}
says() { grep -qF -- "$1" "$work/output" || fail "no \"$1\""; }
says_not() { ! grep -qF -- "$1" "$work/output" || fail "it says \"$1\""; }
until_true() { # WHAT COMMAND...
  local what=$1
  shift
  for _ in $(seq 300); do "$@" && return 0; sleep 0.1; done
  fail "waited in vain: $what"
}
# What a job of another Slurm, in which the command may stand, has in its environment.
outer=(SLURM_JOB_ID=4711 SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_JOB_ID=4710 SBATCH_PARTITION=nowhere SBATCH_ARRAY_INX=5-9
  SBATCH_DEPENDENCY=afterok:4710 SQUEUE_FORMAT=%i SQUEUE_STATES=RUNNING)
batch() { env "${outer[@]}" "$beadwork" batch "$@" --engine "$engine"; }
# In a process of its own, so that it can be killed.
follow() { # COMMAND...
  exec_batch "$@" >"$work/output" 2>&1 &
  follower=$!
  followers+=("$follower")
}
exec_batch() { exec env "${outer[@]}" "$beadwork" batch "$@" --engine "$engine"; }
follower_ends() { # CODE
  local got=0
  wait "$follower" 2>/dev/null || got=$?
  followers=()
  [ "$got" = "$1" ] || fail "exit code $got, not $1"
}
status_of() { # RUN FOLDER
  /usr/bin/python3 -c 'import csv, sys
print(next(row["status"] for row in csv.DictReader(open(sys.argv[2] + "/batch.csv")) if row["run"] == sys.argv[1]))' "$1" "$2"
}
# The table without what is a matter of machine and moment.
table() { # FOLDER
  /usr/bin/python3 - "$1" <<'END'
import csv, sys
with open(sys.argv[1] + "/batch.csv", newline="", encoding="utf-8") as file:
    for row in csv.DictReader(file):
        print(sorted((k, v.replace(sys.argv[1], "")) for k, v in row.items() if "wall" not in k and "speed" not in k))
END
}
same_table() { # FOLDER OTHER
  diff <(table "$1") <(table "$2") >"$work/difference" || fail "the tables of $1 and $2 differ: $(cat "$work/difference")"
}
same_bits() { # FOLDER OTHER RUN
  cmp "$1/$3/curves/force.csv" "$2/$3/curves/force.csv" || fail "other bits: $1/$3"
}
# How many jobs this Slurm has been given so far.
submitted() { squeue --noheader --array --states=all | wc -l; }

cp "$source"/tests/decks/sessions/study_{packing,beams}.xml "$work"
cat >"$work/wild.xml" <<'END'
<scene name="wild">
  <fill>
    <element set="left"  at="0 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
    <element set="right" at="2 0 0 mm" radius="1 mm" density="2000 kg/m^3"/>
  </fill>
  <bond><cohesive-beam name="beam" between="left right" young="100 GPa" radius-ratio="0.5"/></bond>
  <load><hold set="left"/><initial-velocity set="right" velocity="1 0 0 m/s"/></load>
  <move><verlet time-step="1 ms" until="100000"/></move>
</scene>
END
cat >"$work/study.xml" <<'END'
<scene name="study">
  <study>
    <sweep name="late"     decks="study_beams.xml" grid="young = 3 GPa" seeds="1" from="packings = packings" after="wild"/>
    <sweep name="packings" decks="study_packing.xml" seeds="1 2 3"/>
    <sweep name="wild"     decks="wild.xml"/>
    <sweep name="beams"    decks="study_beams.xml" grid="young = 1 GPa, 2 GPa" seeds="1 2" set="end = 20" from="packings = packings"/>
  </study>
</scene>
END
# It runs for seconds; its curve has few rows.
sed 's|until="2000"|until="${n}"|; s|every="20"|every="100000"|g; s|every="1000"|at="end"|; s|<parameter name="v"|<parameter name="n" value="3000000"/>&|' \
  "$source/xml-cases/two-elements/quick.xml" >"$work/long.xml"
long=("$work/long.xml" --vary 'E=50 GPa,100 GPa' --jobs 2 --threads 1)

echo "what others need comes first; a run that fails stops those alone that need it"
out=$work/"it's 100%j of \"a\\b\""$'\n'"study"
expect 3 batch "$work/study.xml" --out "$out"
for run in packings/seed={1,2,3} beams/young={1,2}-GPa,seed={1,2}; do
  says "$run: done"
  [ "$(status_of "$run" "$out")" = "done" ] || fail "$run is not done"
done
says "wild/run: exit code 3, see"
says "late/young=3-GPa,seed=1: skipped: it needs 'wild/run', which is not done"
says "[9/9]"
[ "$(status_of wild/run "$out")" = failed ] || fail "wild is not failed"

echo "the same command does what is not done, and nothing else"
stamps() { stat -c '%n %Y %i' "$out"/packings/*/summary.json "$out"/beams/*/summary.json; }
before=$(stamps)
expect 3 batch "$work/study.xml" --out "$out"
says "9 runs, 7 of them done already"
says "wild/run: exit code 3"
[ "$(stamps)" = "$before" ] || fail "what is done ran again"

echo "what was done is as it is with any engine"
"$beadwork" batch "$work/study.xml" --out "$work/reference" >"$work/output" 2>&1 || true
same_table "$out" "$work/reference"
"$beadwork" batch "${long[@]}" --out "$work/straight" >"$work/output" 2>&1 || fail "the straight run"

is_at() { pgrep -f -- "beadwork run .*--out $1" >/dev/null; }
process_of() { pgrep -f -- "beadwork run .*--out $1" | head -n 1; }
both_run() { is_at "$1/E=50-GPa" && is_at "$1/E=100-GPa" && [ -s "$1/E=50-GPa/curves/force.csv" ] && [ -s "$1/E=100-GPa/curves/force.csv" ]; }

echo "a run that is killed is told, the other goes on, and the same command makes up for it"
follow "${long[@]}" --out "$work/killed"
until_true "both run" both_run "$work/killed"
kill -KILL "$(process_of "$work/killed/E=50-GPa")"
follower_ends 1
says "E=50-GPa: killed by signal 9"
says "E=100-GPa: done"
expect 0 batch "${long[@]}" --out "$work/killed"
says "2 runs, 1 of them done already"
same_table "$work/killed" "$work/straight"
for run in E=50-GPa E=100-GPa; do same_bits "$work/killed" "$work/straight" $run; done

echo "a run that is asked to stop goes on later from where it was"
follow "${long[@]}" --out "$work/asked"
until_true "both run" both_run "$work/asked"
if [ "$engine" = slurm ]; then
  scancel "$(tail -n 1 "$work/asked/batch.jobs" | cut -f 3)_0"
else
  kill -TERM "$(process_of "$work/asked/E=50-GPa")"
fi
follower_ends 5
says "E=50-GPa: interrupted"
[ "$engine" = local ] || says "(Slurm: CANCELLED)"
[ "$(status_of E=50-GPa "$work/asked")" = interrupted ] || fail "not interrupted"
expect 0 batch "${long[@]}" --out "$work/asked"
grep -q "resumed at step" "$work/asked/E=50-GPa/run.log" || fail "begun anew"
same_bits "$work/asked" "$work/straight" E=50-GPa

echo "a command that is killed loses nothing, and the next does nothing twice"
[ "$engine" = local ] || count=$(submitted)
follow "${long[@]}" --out "$work/orphans"
until_true "both run" both_run "$work/orphans"
kill -KILL "$follower"
follower_ends 137
expect 0 batch "${long[@]}" --out "$work/orphans"
[ "$engine" = local ] || says "2 of them are in Slurm's queue already"
same_table "$work/orphans" "$work/straight"
for run in E=50-GPa E=100-GPa; do same_bits "$work/orphans" "$work/straight" $run; done
if [ "$engine" = local ]; then
  grep -q "resumed at step" "$work/orphans/E=50-GPa/run.log" || fail "begun anew"
else
  [ "$(submitted)" = $((count + 2)) ] || fail "submitted twice: $(submitted) jobs, $count before"
  ! grep -q "resumed at step" "$work/orphans/E=50-GPa/run.log" || fail "stopped with its follower"
fi

[ "$engine" = slurm ] || { echo "passed"; exit 0; }
. "$source/tests/architecture/engines_slurm.sh"
echo "passed"
