#!/usr/bin/env bash
# Fuzzes what reads texts and files of others: tools/fuzz.sh [SECONDS EACH] [TARGET...]
# With clang's libFuzzer, sanitizers of addresses, undefined behaviour and leaks; decks besides by tests/fuzz/decks.py, which changes whole
# decks and asks the program itself. What is found stands in build/fuzz/found.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
shift $(($# > 0 ? 1 : 0))
command -v clang++ >/dev/null || { echo "clang++ is wanted (Debian: clang, libclang-rt-dev)"; exit 1; }
cmake -S . -B build/fuzz -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER=clang++ -DBEADWORK_FUZZ=ON >/dev/null
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(units expression deck stl packing_text run_file curve decks)
for target in "${targets[@]}"; do
  [ "$target" = decks ] || ninja -C build/fuzz "fuzz_$target"
done
mkdir -p build/fuzz/found
export ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 TMPDIR=/dev/shm
worst=0
for target in "${targets[@]}"; do
  echo "== $target"
  if [ "$target" = decks ]; then
    /usr/bin/python3 tests/fuzz/decks.py "${BEADWORK:-build/release/bin/beadwork}" xml-cases tests/decks --seconds "$seconds" --found build/fuzz/found || worst=1
    continue
  fi
  mkdir -p "build/fuzz/corpus/$target"
  "build/fuzz/tests/fuzz/fuzz_$target" "build/fuzz/corpus/$target" "tests/fuzz/corpus/$target" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=4096 \
    -max_len=65536 -dict="tests/fuzz/words.dict" -artifact_prefix="build/fuzz/found/$target-" -print_final_stats=1 2>"build/fuzz/found/$target.log" || worst=1
  grep -E "stat::number_of_executed_units|SUMMARY|cov:" "build/fuzz/found/$target.log" | tail -3
done
exit "$worst"
