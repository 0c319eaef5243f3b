#!/usr/bin/env bash
# beadwork plan foretells what a run then does.   Usage: plan.sh SOURCE_FOLDER BEADWORK
set -euo pipefail
source=$1 beadwork=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $1"; cat "$work/plan"; exit 1; }
says() { grep -qF -- "$1" "$work/plan" || fail "the plan does not say: $1"; }
value() { grep "\"$1\"" "$work/out/summary.json" | head -1 | sed 's/.*: //; s/,$//'; }

echo "steps of a deck that ends at a displacement"
sed 's|until="2000"|until="0.5 um"|' "$source/xml-cases/two-elements/quick.xml" >"$work/deck.xml"
"$beadwork" plan "$work/deck.xml" --fill >"$work/plan"
"$beadwork" run "$work/deck.xml" --out "$work/out" --quiet --threads 1
says "stage 'run': $(value steps) steps at most"
says "time step $(value time_step | awk '{ printf "%.4g", $1 }') s, limited by"
says "bonds of 'beam'                       1"
for watcher in force-curve energy-ledger snapshot; do says "s per look of watch.$watcher"; done
grep -qE "steps at most, about [0-9.e-]+ s, of which [0-9.e-]+ s for looks" "$work/plan" || fail "no time of the loop and its looks"
grep -qE "^  curves/force.csv +force-curve right: displacement \[m\], force \[N\]" "$work/plan" || fail "no curve is listed"
says "keeps: verlet; reads: cohesive-beam"
says "columns that cohesive-beam beam offers and nobody reads: section-radius, bending-moment, twisting-moment"

echo "no rotations where nobody turns"
cat >"$work/deck.xml" <<'DECK'
<scene>
  <fill><lattice set="all" count="3 2 1" radius="1 mm" density="2000 kg/m^3"/></fill>
  <bond><cohesive-contact name="glue" between="all all" strength="1 MPa" energy="100 J/m2" onset-ratio="0.1"/></bond>
  <move><verlet until="1 us"/></move>
</scene>
DECK
"$beadwork" plan "$work/deck.xml" >"$work/plan"
[[ -z $(tail -c 1 "$work/plan") ]] || fail "the last line does not end"
says "rotations: nobody reads orientations or adds torques"
says "forces and moments of single bonds: nobody reads them"
! grep -q "^  spin" "$work/plan" || fail "there is a spin"

echo "but where a contact has a normal of its own"
sed 's|onset-ratio|modes="both" normal="plane" plane-normal="1 1 1" onset-ratio|' "$work/deck.xml" >"$work/plane.xml"
"$beadwork" plan "$work/plane.xml" --fill >"$work/plan"
grep -qE "limited by element [0-9]+, which turns \(stiffest bond: one of 'glue'\)" "$work/plan" || fail "turning does not limit the step"
grep -qE "^  normal-1 " "$work/plan" || fail "no normal is kept"
! grep -qE "^  (rest-length|mode-mix|integrity) " "$work/plan" || fail "a column of another law"

echo "nor among springs"
sed 's|<cohesive-contact .*/>|<spring name="glue" between="all all" young="1 GPa"/>|' "$work/deck.xml" >"$work/springs.xml"
"$beadwork" plan "$work/springs.xml" >"$work/plan"
says "rotations: nobody reads orientations or adds torques"
says "spring glue offers and nobody reads: section-radius, axial-force"
! grep -qE "^  (orientation|spin|torque|inertia) " "$work/plan" || fail "there is a rotation"

echo "when watchers look"
sed 's|</scene>|<watch><energy-ledger at="0.3 us, 7"/><energy-ledger name="e" every="5" at="9"/></watch></scene>|' "$work/deck.xml" >"$work/looks.xml"
"$beadwork" plan "$work/looks.xml" >"$work/plan"
says "energy-ledger (at 0.3 us, 7), energy-ledger (every 5 steps, at 9)"

echo "every shipped deck can be planned"
for deck in "$source"/xml-cases/*/quick.xml; do
  grep -q "<study>" "$deck" && continue
  "$beadwork" plan "$deck" >"$work/plan" || fail "$deck"
done
echo "passed"
