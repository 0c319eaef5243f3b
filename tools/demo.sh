#!/usr/bin/env bash
# From a fresh Debian 12 to a result: installs, builds, runs the quick double cantilever beam, writes its report.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/build.sh release -DBEADWORK_TESTS=OFF
build/release/bin/beadwork run xml-cases/dcb/quick.xml --out out/demo --overwrite
echo
echo "Force against displacement, beside Eq (10) of the paper, and pictures of the specimen:"
build/release/bin/beadwork report out/demo
