#!/usr/bin/env bash
# Looks at a change before it is sent: format, who includes whom, generated pages, quick tests. Fit for a git hook:
#   ln -s ../../tools/check.sh .git/hooks/pre-commit
# --fix  formats the sources instead of complaining about them.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

fix=${1:-}
command -v clang-format >/dev/null || { echo "check: clang-format is missing: apt-get install clang-format" >&2; exit 1; }
mapfile -t sources < <(git ls-files '*.hpp' '*.cpp')
if [ "$fix" = --fix ]; then
  clang-format -i "${sources[@]}"
else
  clang-format --dry-run --Werror "${sources[@]}" || { echo "check: tools/check.sh --fix formats these" >&2; exit 1; }
fi

if [ -d build/release ]; then
  cmake --build --preset release
  ctest --test-dir build/release --output-on-failure -R '^(unit|architecture/(include|manual|docs))'
else
  echo "check: no build yet, so no test was run: ./tools/test.sh makes one" >&2
fi
