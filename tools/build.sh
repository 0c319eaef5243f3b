#!/usr/bin/env bash
# Installs what is missing, configures and builds one preset: tools/build.sh [release] [cmake arguments...]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}
[ $# -gt 0 ] && shift
tools/install-packages.sh
cmake --preset "$preset" "$@" >/dev/null
cmake --build --preset "$preset"
