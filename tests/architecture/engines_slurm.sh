# What Slurm alone can do. Sourced by engines.sh, whose names it uses.
# shellcheck shell=bash disable=SC2154

echo "everything is cleared away behind what is done"
[ -z "$(find "$work/killed/batch.slurm" -name '*.note')" ] || fail "notes are left"
[ "$(sort "$work/killed/batch.files" | uniq -d)" = "" ] && grep -qx batch.jobs "$work/killed/batch.files" || fail "batch.jobs is not listed"

echo "a job that Slurm starts once more goes on from its checkpoint"
follow "${long[@]}" --out "$work/requeued"
until_true "both run" both_run "$work/requeued"
scontrol requeue "$(tail -n 1 "$work/requeued/batch.jobs" | cut -f 3)_0"
follower_ends 0
grep -q "resumed at step" "$work/requeued/E=50-GPa/run.log" || fail "begun anew"
same_table "$work/requeued" "$work/straight"
same_bits "$work/requeued" "$work/straight" E=50-GPa

echo "whoever is interrupted leaves the jobs to Slurm; nobody else may run them meanwhile"
slow=("$work/long.xml" --vary 'E=50 GPa,100 GPa' --jobs 1 --set n=1000000000)
follow "${slow[@]}" --out "$work/left"
until_true "one runs" is_at "$work/left/E=50-GPa"
kill -INT "$follower"
follower_ends 5
says "2 runs are with Slurm, which goes on without this command"
cancel=$(grep -o 'scancel [0-9 ]*' "$work/output")
is_at "$work/left/E=50-GPa" || fail "the job has gone"
expect 2 "$beadwork" batch "${slow[@]}" --out "$work/left"
says "is in Slurm's queue"
! is_at "$work/left/E=100-GPa" || fail "two at once, not one"
follow "${slow[@]}" --out "$work/left"
until_true "it follows" grep -q "2 of them are in Slurm's queue already" "$work/output"
$cancel
follower_ends 1
says "E=50-GPa: interrupted (Slurm: CANCELLED), goes on"
says "E=100-GPa: Slurm: "

echo "who is killed between submitting and noting it is not forgotten"
mkdir "$work/bin"
printf '#!/bin/bash\n%q "$@"\nkill -KILL $PPID\n' "$(command -v sbatch)" >"$work/bin/sbatch"
chmod +x "$work/bin/sbatch"
count=$(submitted)
PATH="$work/bin:$PATH" follow "${long[@]}" --out "$work/unnoted"
follower_ends 137
! grep -q ^number "$work/unnoted/batch.jobs" || fail "it has noted the number"
expect 0 batch "${long[@]}" --out "$work/unnoted"
says "2 of them are in Slurm's queue already"
[ "$(submitted)" = $((count + 2)) ] || fail "submitted twice: $(submitted) jobs, $count before"

echo "what Slurm does not take now is submitted later"
cat >"$work/bin/sbatch" <<END
#!/bin/bash
# Two jobs at a time, as a limit of a user would have it.
for word; do case \$word in --array=0-*) last=\${word#--array=0-} ;; esac; done
here=\$(squeue --noheader --array | wc -l)
if [ \$((here + \${last%%%*} + 1)) -gt 2 ]; then
  echo "sbatch: error: AssocMaxSubmitJobLimit" >&2
  echo "sbatch: error: Batch job submission failed: Job violates accounting/QOS policy (job submit limit, user's size and/or time limits)" >&2
  exit 1
fi
exec $(printf %q "$(command -v sbatch)") "\$@"
END
PATH="$work/bin:$PATH" expect 0 batch "$work/long.xml" --set n=10 --vary 'E=50 GPa,60 GPa,70 GPa,80 GPa,90 GPa' --out "$work/limited"
says "Slurm takes no more jobs now"
says "[5/5]"

echo "submit and leave, with words for sbatch; another command gathers"
expect 0 batch "$work/study.xml" --out "$work/study" --no-wait --sbatch '--partition=all --time=10' --sbatch=--nice
says "9 runs are with Slurm"
[ "$(squeue --noheader --array --format=%l | sort -u)" = 10:00 ] || fail "not with a time limit: $(squeue --format=%l)"
[ "$(awk -F'\t' '/^jobs/ && NF > 5' "$work/study/batch.jobs")" = "" ] || fail "an array of more than three"
until_true "nobody is in the queue" eval '[ -z "$(squeue --noheader)" ]'
[ -f "$work/study/beams/young=2-GPa,seed=2/summary.json" ] || fail "what waits for others has not run by itself"
[ ! -e "$work/study/late/young=3-GPa,seed=1" ] || fail "what needs a failed run has begun"
expect 3 batch "$work/study.xml" --out "$work/study"
says "9 runs, 7 of them done already"
same_table "$work/study" "$work/reference"

echo "what sbatch refuses is told"
expect 1 batch "$work/long.xml" --out "$work/refused" --sbatch '-p nowhere'
says "invalid partition specified: nowhere"
for words in '--array=1-2' '-a 1' '--arr=1' 'long' '--wrap=ls' '-- x'; do
  expect 2 batch "$work/long.xml" --out "$work/refused" --sbatch "$words"
  says "error: --sbatch "
done
