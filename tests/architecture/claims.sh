#!/usr/bin/env bash
# What a study expects of its runs: claims in and out of their bands, ratios of runs, figures, the page.   Usage: claims.sh SOURCE_FOLDER BEADWORK
set -euo pipefail
source=$1 beadwork=$2
work=$(mktemp -d)
trap '[ -n "${KEEP:-}" ] || rm -rf "$work"' EXIT
sed 's|until="2000"|until="${n}"|; s|<parameter name="v"|<parameter name="n" value="2000"/><parameter name="seed" value="1"/>&|; s|seed="1"|seed="${if(seed > 2, 0.5, seed)}"|' \
  "$source/xml-cases/two-elements/quick.xml" >"$work/pull.xml"

fail() { echo "FAILED: $1"; cat "$work/output"; exit 1; }
expect() { # CODE COMMAND...
  local code=$1 got=0
  shift
  "$@" >"$work/output" 2>&1 || got=$?
  [ "$got" = "$code" ] || fail "exit code $got, not $code: $*"
}
says() { grep -qF -- "$1" "$work/output" || fail "no \"$1\""; }
study() { # CLAIMS -> study.xml
  cat >"$work/study.xml" <<END
<scene name="expected">
  <study>
    <sweep name="pulled" decks="pull.xml" grid="E = 50 GPa, 100 GPa" seeds="1 to 2"/>
    $1
  </study>
</scene>
END
}
claim() { # NAME COLUMN -> its cell in claims.csv
  /usr/bin/python3 -c 'import csv, sys; print(next(r[sys.argv[2]] for r in csv.DictReader(open(sys.argv[3])) if r["claim"] == sys.argv[1]))' "$1" "$2" "$work/out/claims.csv"
}
is() { [ "$(claim "$1" "$2")" = "$3" ] || fail "$1: $2 is '$(claim "$1" "$2")', not '$3'"; }
batch=("$beadwork" batch "$work/study.xml" --out "$work/out" --jobs 2)

echo "claims are held beside what the runs have found, means of seeds"
study '<claim name="A" says="the force at the end" of="pulled" where="E = 50 GPa" curve="force" read="last force" printed="1 N" from="1e-9 N" to="1 GN"/>
    <claim name="B" says="twice as stiff" of="pulled" where="E = 100 GPa" beside="E = 50 GPa" curve="force" read="slope of force over displacement from 0 um to 0.1 um" printed="2" from="1.99" to="2.01"/>
    <claim name="C" says="thrice as stiff" source="Fig &lt;1&gt;" of="pulled" where="E = 100 GPa" beside="E = 50 GPa" curve="force" read="largest force" printed="3" from="2.9"/>
    <claim name="D" says="it falls" of="pulled" where="E = 50 GPa; seed = 1" curve="force" read="displacement where force falls below 1 percent of its largest" from="0 m"/>
    <claim name="E" says="strain" of="pulled" where="E = 50 GPa" curve="force" read="displacement at the largest force" over="last displacement" times="3 1/m"/>
    <claim name="F" says="of the table" of="pulled" where="E = 50 GPa" column="energy: work" from="0"/>
    <claim name="G" says="another kind" of="pulled" where="E = 50 GPa" curve="force" read="last force" from="1 J"/>
    <claim name="H" says="misspelt" of="pulled" where="E = 50 GPa" curve="force" read="last forse" from="0"/>
    <claim name="I" says="of the run" of="pulled" where="E = 50 GPa" column="steps" from="2000" to="2000"/>
    <figure name="Fig 1" says="curves of both" of="pulled" where="seed = 1" curve="force"/>
    <figure name="Fig 2" says="pictures" of="pulled" where="E = 50 GPa; seed = 1" pictures="yes"/>'
expect 0 "${batch[@]}"
says "claims: 4 in their bands, 1 out of them, 4 others"
is A verdict in
is A runs 2
is B mean 2
is B verdict in
is C verdict out
is D verdict "not reached"
is E mean "3 1/m"
is E verdict "no band"
is F verdict in
is G verdict "not read"
is G remark "the band is not in N"
is H verdict "not read"
is H remark "there is no column 'forse'"
is I mean 2000
/usr/bin/python3 - "$work/out" <<'END' || fail "a claim and its run differ"
import csv, sys
out = sys.argv[1]
rows = list(csv.reader(open(f"{out}/pulled/E=50-GPa,seed=1/curves/force.csv")))
force = float(rows[-1][[name.split(" ")[0] for name in rows[0]].index("force")])
claim = next(r for r in csv.DictReader(open(f"{out}/claims.csv")) if r["claim"] == "A")
number, unit = claim["mean"].split(" ")
assert unit == "N" and abs(float(number) / force - 1) < 1e-3 and float(claim["scatter"].split(" ")[0]) == 0, (claim, force)
END

echo "the page has them, with figures"
expect 0 "$beadwork" report "$work/out"
page=$work/out/report.html
grep -q 'Fig &lt;1&gt;' "$page" && grep -q '<h3>Fig 1: curves of both' "$page" && grep -q '<h3>Fig 2: pictures' "$page" || fail "no claims or figures"
grep -q 'badge failed">out<' "$page" && grep -q 'badge done">in<' "$page" || fail "no verdicts"

echo "a claim that is added later needs no run"
study '<claim name="A" says="the force at the end" of="pulled" where="E = 100 GPa; seed = 2" curve="force" read="last force" from="1 GN"/>'
expect 0 "${batch[@]}"
says "4 of them done already"
is A verdict out

echo "what no longer is expected is no longer told; runs that have failed are"
study '<claim name="A" says="half of them fail" of="pulled" where="E = 50 GPa" curve="force" read="last force" from="0"/>'
sed -i 's|seeds="1 to 2"|seeds="1 to 3"|' "$work/study.xml"
expect 2 "${batch[@]}" --keep-going
is A verdict "in so far"
is A runs 2
is A of 3
study ''
"${batch[@]}" >/dev/null 2>&1 || true
[ "$(wc -l <"$work/out/claims.csv")" = 1 ] || fail "an old claim stands"

refused() { # CLAIM WORDS
  study "$1"
  expect 2 "${batch[@]}"
  says "$2"
  says "study.xml:4:"
}
echo "what cannot be claimed is refused before anything runs"
refused '<claim name="A" says="x" of="pulld" curve="force" read="last force"/>' "there is no sweep 'pulld'"
refused '<claim name="A" says="x" of="pulled" where="E = 70 GPa" curve="force" read="last force"/>' "no run of 'pulled' has E = 70 GPa"
refused '<claim name="A" says="x" of="pulled" where="E" curve="force" read="last force"/>' "'where' wants name = values"
refused '<claim name="A" says="x" of="pulled" curve="force" read="biggest force"/>' "wants one of"
refused '<claim name="A" says="x" of="pulled" curve="force"/>' "what is read from it"
refused '<claim name="A" says="x" of="pulled" curve="force" read="last force" from="3 N" to="2 N"/>' "holds no number"
refused '<claim name="A" says="x" of="pulled" curve="force" read="last force" from="3 newts"/>' "wants a number with its unit"
refused '<claim name="A" says="x" of="pulled" column="steps" read="last force"/>' "a 'column' has one number"
refused '<claim name="A" says="x" of="pulled"/>' "exactly one of"
refused '<figure name="A" says="x" of="pulled" where="seed = 3" curve="force"/>' "no run of 'pulled' has seed = 3"
refused '<sweep name="more" decks="pull.xml" seeds="3 to 1"/>' "the smaller one first"
refused '<claim name="A" says="x" of="pulled" curve="force" read="last force"/>' "in their seeds only"
refused '<claim name="A" says="x" of="pulled" where="E = 50 GPa" beside="seed = 1" curve="force" read="last force"/>' "and one is wanted"
refused '<claim name="A" says="x" of="pulled" where="E = 50 GPa" curve="../force" read="last force"/>' "no path"
refused '<claim name="A" says="x" of="pulled" where="E = 50 GPa" curve="force" read="mean force for displacement from 2 um to 1 um"/>' "wants one of"
refused '<figure name="A" says="x" of="pulled" pictures="no"/>' "name it instead"
printf '<scene name="none"><study><claim name="A" says="x" of="x" curve="c" read="last y"/></study></scene>' >"$work/study.xml"
expect 2 "${batch[@]}"
says "it wants a <sweep>"
echo "all held"
