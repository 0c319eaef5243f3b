#!/usr/bin/env bash
# Every shipped deck is valid against the schema made from the plugins; a misspelt one is not.
# Usage: decks_validate.sh SOURCE_FOLDER BEADWORK
set -euo pipefail
source=$1 beadwork=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$beadwork" describe --format xsd >"$work/beadwork.xsd"

mapfile -t decks < <(find "$source/xml-cases" "$source/tests/decks/good" -name '*.xml' | sort)
[ ${#decks[@]} -gt 0 ] || { echo "no decks found"; exit 1; }
xmllint --noout --schema "$work/beadwork.xsd" "${decks[@]}"

refuse() {
  printf '<scene>%s</scene>\n' "$1" >"$work/wrong.xml"
  if xmllint --noout --schema "$work/beadwork.xsd" "$work/wrong.xml" 2>/dev/null; then
    echo "the schema accepts $1"
    exit 1
  fi
}
refuse '<bond><cohesive-bean/></bond>'
refuse '<fil/>'
refuse '<load><hold/></load>'
refuse '<load><hold set="a" axis="x"/></load>'
refuse '<load><hold set="a" axes="x w"/></load>'
refuse '<load><pull set="a" axis="x" velocity="0,3 m/s"/></load>'
refuse '<load><pull set="a" axis="x" velocity="3"/></load>'
refuse '<load><pull set="a" axis="x" velocity="3 m/s 4 m/s"/></load>'
refuse '<stage><fill/></stage>'
echo "${#decks[@]} decks are valid"
