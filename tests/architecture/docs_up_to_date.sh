#!/usr/bin/env bash
# The reference in docs/ is what the plugins declare.   Usage: docs_up_to_date.sh SOURCE_FOLDER BEADWORK
set -euo pipefail
reference=$1/docs/reference beadwork=$2
same() {
  "$beadwork" describe --format "$2" | diff -u "$reference/$1" - && return
  echo "docs/reference/$1 is out of date: run tools/update-docs.sh"
  exit 1
}
same deck.md md
same beadwork.xsd xsd
echo "docs/reference is up to date"
