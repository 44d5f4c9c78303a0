#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures how the time of a run grows with the numbers of faces, vertices and heads: runs
# scripts/bench_crowd.sh for three series, in which the size doubles from run to run, and prints its table. Each
# run prepares the heads again, in a cache that is removed at the end.
#
#   scripts/bench_scaling.sh
set -euo pipefail
cd "$(dirname "$0")/.."
cache=$(mktemp -d)
trap 'rm -rf "$cache"' EXIT

header=1
run() {
  rm -rf "$cache"
  scripts/bench_crowd.sh "$@" --cache "$cache" -q 2>/dev/null | tail -n $((1 + header))
  [ $header -eq 0 ] || header=0
}
for faces in 50 100 200 400; do run 15 26000 $faces; done
for vertices in 50000 100000 200000 400000; do run 15 $vertices 32; done
for heads in 4 8 16 32; do run $heads 26000 50; done
