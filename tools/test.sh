#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests. Further arguments go to ctest: tools/test.sh -R beam
set -euo pipefail
cd "$(dirname "$0")/.."
# A Slurm for the test of batches in a queue. It brings services, so that nobody gets them on a machine of his own unasked.
if [ "$(id -u)" -eq 0 ]; then
  tools/install-packages.sh slurm-wlm munge || echo "test: no Slurm can be installed; its test is skipped" >&2
fi
tools/build.sh release -DBEADWORK_TESTS=ON
ctest --preset release --parallel "$(nproc)" "$@"
