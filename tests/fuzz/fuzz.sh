#!/bin/sh
# Fuzzes each reader and the whole pipeline: fuzz.sh [seconds per target, 60]. New inputs that reach new code stay in
# build/fuzz/found; what is worth keeping goes to tests/fuzz/corpus by `fuzz.sh merge`. Findings stop it with the input's
# name.
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:-60}
cmake --preset fuzz
cmake --build --preset fuzz
export LSAN_OPTIONS="suppressions=$PWD/core/toolchain/lsan.supp:print_suppressions=0"
for target in read_json read_off read_poly pipeline; do
  corpus=tests/fuzz/corpus/$target
  found=build/fuzz/found/$target
  mkdir -p "$found" build/fuzz/findings
  if [ "$seconds" = merge ]; then
    "build/fuzz/fuzz-$target" -merge=1 -max_len=4096 "$corpus" "$found" 2>/dev/null
    continue
  fi
  echo "fuzz: $target, $seconds s"
  "build/fuzz/fuzz-$target" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -max_len=4096 -print_final_stats=1 \
    -verbosity=0 -artifact_prefix="build/fuzz/findings/$target-" "$found" "$corpus"
done
