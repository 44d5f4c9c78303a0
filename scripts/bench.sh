#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds and runs the benchmarks at full size. Only times of the same run are comparable. The output lists each
# benchmark next to its baseline; the counters named "ratio…" compare both.
#
#   scripts/bench.sh                    all benchmarks
#   scripts/bench.sh SUBJECT [OPTION …] one program, such as: scripts/bench.sh core --benchmark_filter=Hash
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh
if [ $# -gt 0 ]; then
  program=crowdface_${1}_bench
  shift
  scripts/build.sh release "$program"
  exec "build/release/bin/$program" "$@"
fi
scripts/build.sh release benchmarks
for program in build/release/bin/crowdface_*_bench; do
  echo "== $(basename "$program")"
  "$program"
done
