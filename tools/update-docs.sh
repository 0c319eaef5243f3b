#!/usr/bin/env bash
# Writes docs/reference/ anew, from the declarations in the plugins: tools/update-docs.sh [path of beadwork]
set -euo pipefail
cd "$(dirname "$0")/.."
beadwork=${1:-build/release/bin/beadwork}
mkdir -p docs/reference
for pair in md:deck.md xsd:beadwork.xsd; do
  "$beadwork" describe --format "${pair%%:*}" >docs/reference/new
  mv docs/reference/new "docs/reference/${pair##*:}"
done
