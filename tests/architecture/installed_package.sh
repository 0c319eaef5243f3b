#!/usr/bin/env bash
# The installed package, moved elsewhere, is all that a plugin of one's own needs; and what is wrong with such a library,
# or goes wrong in it, is told by name.   Usage: installed_package.sh SOURCE_FOLDER BUILD_FOLDER CXX_COMPILER
set -euo pipefail
source=$1 build=$2 compiler=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
beadwork=$work/moved/bin/beadwork

fail() {
  echo "FAILED: $1"
  [ ! -f "$work/output" ] || cat "$work/output"
  exit 1
}
# expect CODE TEXT... -- COMMAND...: the command ends with that exit code, and its output has each of the texts.
expect() {
  local code=$1 got=0 texts=()
  shift
  while [ "$1" != -- ]; do texts+=("$1"); shift; done
  shift
  "$@" >"$work/output" 2>&1 || got=$?
  [ "$got" = "$code" ] || fail "exit code $got, not $code: $*"
  for text in "${texts[@]}"; do grep -qF -- "$text" "$work/output" || fail "no \"$text\" in the output of: $*"; done
}
build_project() {
  expect 0 -- cmake -S "$1" -B "$2" -DCMAKE_PREFIX_PATH="$work/moved" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Debug
  expect 0 -- cmake --build "$2"
}

echo "install, and move the folder"
expect 0 -- cmake --install "$build" --prefix "$work/installed"
mv "$work/installed" "$work/moved"
expect 0 cohesive-beam verlet -- "$beadwork" describe
for file in share/beadwork/beadwork.xsd share/beadwork/deck.md include/beadwork/core/version.hpp share/beadwork/examples/plugins/load/pull.cpp; do
  [ -f "$work/moved/$file" ] || fail "$file is not installed"
done

echo "build the plugin template against it, and run its deck"
build_project "$work/moved/share/beadwork/examples/plugin-template" "$work/template"
ropes=$work/template/ropes.so
deck=$source/tools/plugin-template/three-balls.xml
expect 0 stiffness stretch -- "$beadwork" describe rope --plugins "$ropes"
expect 0 "no errors" -- "$beadwork" check "$deck" --plugins "$ropes"
expect 0 -- "$beadwork" run "$deck" --plugins "$ropes" --out "$work/out" --threads 1
# step, time, displacement, force, reference: two ropes in series, within 2 percent at the end of the slow pull
tail -n 1 "$work/out/curves/force.csv" | awk -F, '{ if ($5 <= 0 || ($4 / $5 - 1) ^ 2 > 0.02 ^ 2) { print "force " $4 ", expected " $5; exit 1 } }' ||
  fail "the ropes pull with another force than k/2 times the displacement"
expect 2 "no <rope> in <bond>" -- "$beadwork" check "$deck"

echo "a load of one's own is watched by force-curve, until and at; a curve of one's own is written at its moments"
expect 0 "reached force of right > 15 N" -- "$beadwork" run "$source/tools/plugin-template/shaken.xml" --plugins "$work/template" --out "$work/shaken" --threads 1
/usr/bin/python3 - "$work/shaken/curves" <<'END' || fail "the shaken rope does not pull with k times the displacement, or its centroid is elsewhere"
import csv, sys
def rows(name):
    names, *lines = csv.reader(open(f"{sys.argv[1]}/{name}.csv"))
    return [dict(zip([n.split(" ")[0] for n in names], map(float, line))) for line in lines]
force, place = rows("force"), rows("centroid")
last = force[-1]
assert 14 < last["force"] < 16 and abs(last["force"] / last["reference"] - 1) < 0.01, last
crossed = [row for row in place if row["step"] % 10]          # the look at 0.007 mm, or at the end
assert any(abs(row["x"] - 2.007e-3) < 1e-8 for row in crossed), crossed
assert all(abs(p["x"] - 2e-3 - f["displacement"]) < 1e-12 for p, f in zip(place, force) if p["step"] == f["step"]), "apart"
END

echo "the resolved deck names the library that the command line named"
mkdir "$work/it's here"
cp "$ropes" "$work/it's here/my ropes.so"
expect 0 -- "$beadwork" run "$deck" --plugins "$work/it's here/my ropes.so" --out "$work/named" --threads 1
expect 0 -- env -C / "$beadwork" run "$work/named/resolved.xml" --out "$work/again" --threads 1
cmp "$work/out/curves/force.csv" "$work/again/curves/force.csv" && cmp "$work/named/resolved.xml" "$work/again/resolved.xml" || fail "the resolved deck is another one"

echo "a plugin of ours can be copied, renamed and built, with what it includes"
mkdir -p "$work/copy/fill"
sed 's/Lattice/Grid/g' "$work/moved/share/beadwork/examples/plugins/fill/lattice.cpp" >"$work/copy/fill/grid.cpp"
printf 'cmake_minimum_required(VERSION 3.25)\nproject(Copy LANGUAGES CXX)\nfind_package(Beadwork 0.1 REQUIRED)\nbeadwork_add_plugins(copy NAMESPACE beadwork fill/grid.cpp)\n' \
  >"$work/copy/CMakeLists.txt"
build_project "$work/copy" "$work/copied"
expect 0 count density -- "$beadwork" describe grid --plugins "$work/copied/copy.so"

echo "a resume knows a library that has changed"
cp "$work/it's here/my ropes.so" "$work/original"
printf 'another build' >>"$work/it's here/my ropes.so"
expect 2 "my ropes.so has changed since the run began" -- "$beadwork" run "$deck" --plugins "$work/it's here/my ropes.so" --out "$work/named" --threads 1 --resume
cp "$work/original" "$work/it's here/my ropes.so"
expect 0 -- "$beadwork" run "$deck" --plugins "$work/it's here/my ropes.so" --out "$work/named" --threads 1 --resume

echo "what is told of bonds holds for a law of one's own: dashpots, for one"
expect 0 -- "$beadwork" run "$source/tests/architecture/installed_package/damped.xml" --plugins "$ropes" --out "$work/damped" --threads 1
/usr/bin/python3 - "$work/damped/curves/energy.csv" <<'END' || fail "dashpots take another share of the energy than their damping ratio says"
import csv, math, sys
names, *rows = csv.reader(open(sys.argv[1]))
kinetic = [float(row[[n.split(" ")[0] for n in names].index("kinetic")]) for row in rows]
zeta = 0.2
expected = math.exp(-2 * math.pi * zeta / math.sqrt(1 - zeta**2))
print(kinetic[-1] / kinetic[0], "expected", expected)
sys.exit(abs(kinetic[-1] / kinetic[0] / expected - 1) > 0.005)
END

echo "a library for another kernel is refused, with both stamps"
build_project "$source/tests/architecture/installed_package" "$work/others"
expect 4 "library: beadwork 0.0.1, another compiler" "program: beadwork " -- "$beadwork" check "$deck" --plugins "$work/others/foreign.so"

echo "a plugin in two libraries is refused, naming both"
cp "$ropes" "$work/ropes-again.so"
expect 4 "ropes.so" "ropes-again.so" "<bond> <rope>" -- "$beadwork" check "$deck" --plugins "$ropes" --plugins "$work/ropes-again.so"

echo "a plugin that throws in the middle of a run is named, with the step"
expect 3 "step 40" "watch.tripwire" "the wire was touched" -- "$beadwork" run "$source/tests/architecture/installed_package/tripwire.xml" \
  --plugins "$work/others/tripwires.so" --out "$work/tripped" --threads 1
grep -q '"status": "failed"' "$work/tripped/summary.json" || fail "summary.json does not say that the run failed"
echo "passed"
