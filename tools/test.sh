#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests. Further arguments go to ctest: tools/test.sh -R beam
set -euo pipefail
cd "$(dirname "$0")/.."
tools/build.sh release -DBEADWORK_TESTS=ON
ctest --preset release "$@"
