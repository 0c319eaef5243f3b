#!/usr/bin/env bash
# What a scene does not ask for, or not at this step, takes no instruction of that step: counted by valgrind, not by the clock.
# Usage: unasked_costs_nothing.sh BEADWORK
set -euo pipefail
beadwork=$1
export BEADWORK_INSTRUCTIONS=avx2  # the widest that valgrind knows
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# section, what is put there -> a deck of 512 elements on beams. They are at rest, so that the last frame, which each snapshot records, is
# compressed to the same bytes after few steps as after many: what that takes is no part of a step.
deck() {
  cat >"$work/$1.xml" <<DECK
<scene name="block">
  <parameter name="steps" value="200"/>
  <fill><lattice set="all" count="8 8 8" radius="1 mm" density="2000 kg/m^3"/></fill>
  <bond><${3:-cohesive-beam} name="bond" between="all all" young="70 GPa" radius-ratio="0.5"/></bond>
  <move><verlet until="\${steps}"/></move>
  ${2:-}
</scene>
DECK
}
counted() { # deck, steps -> instructions of the whole run
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$beadwork" run "$work/$1.xml" --set steps="$2" --threads 1 --quiet --out "$work/out" \
    --overwrite 2>&1 | sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}
a_step() {
  local few many
  few=$(counted "$1" 200)
  many=$(counted "$1" 400)
  echo $(((many - few) / 200))
}

deck bare
deck snapshot '<watch><snapshot fields="displacement velocity axial-force" every="1000000"/></watch>'
deck rare '<fail><bond-stress of="bond" strength="1e30 Pa" every="1000000"/></fail>'
deck judged '<fail><bond-stress of="bond" strength="1e30 Pa"/></fail>'
deck defects '<fail><defects of="bond" share="0.001"/></fail>'
deck springs '' spring

bare=$(a_step bare)
echo "beams alone: $bare instructions a step"
failed=0
holds() { # name, what it is, sign, percent of the bare scene
  local count percent
  count=$(a_step "$1")
  percent=$(awk -v a="$count" -v b="$bare" 'BEGIN { printf "%.2f", 100 * a / b }')
  echo "$2: $count, $percent percent"
  awk -v p="$percent" "BEGIN { exit !(p $3 $4) }" || { echo "    wanted $3 $4 percent"; failed=1; }
}
holds snapshot "with a snapshot of derived fields and of bonds, at other steps" "<" 100.5
holds rare "with a criterion, judged at other steps" "<" 100.5
holds judged "with a criterion, judged at each step" ">" 120
holds defects "with defects, which are there from the start" "<" 100.5
holds springs "springs instead of beams: no rotations" "<" 40
exit $failed
