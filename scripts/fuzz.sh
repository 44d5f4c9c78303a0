#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes the parsers, one after the other, with AddressSanitizer and UBSan. What is found stays in
# build/fuzz/found; once mended it belongs into tests/fuzz/corpus, where a test reads it for ever.
#
#   scripts/fuzz.sh [SECONDS [PARSER …]]    by default 1200 s each of obj mask yaml review plan cache
#                                           ledger; needs the Debian packages clang, libclang-rt-14-dev
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-1200}
shift || true
parsers=("$@")
[ ${#parsers[@]} -gt 0 ] || parsers=(obj mask yaml review plan cache ledger)

scripts/build.sh fuzz $(printf 'crowdface_%s_fuzz ' "${parsers[@]}")
mkdir -p build/fuzz/found
status=0
for parser in "${parsers[@]}"; do
  mkdir -p "build/fuzz/corpus/$parser"
  log=build/fuzz/$parser.log
  if build/fuzz/bin/crowdface_${parser}_fuzz "build/fuzz/corpus/$parser" "tests/fuzz/corpus/$parser" \
    -max_total_time="$seconds" -max_len=65536 -rss_limit_mb=4096 -timeout=20 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/found/$parser-" >"$log" 2>&1; then
    printf '%-8s %12s runs, nothing found\n' "$parser" \
      "$(awk '/number_of_executed_units/ {print $2}' "$log")"
  else
    printf '%-8s FOUND, see %s\n' "$parser" "$log"
    status=1
  fi
done
exit $status
