#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Test 13 of docs/reliability.md for several compilers and optimisation levels: builds the test of the golden
# crowds with each, and compares the crowds' hashes with tests/golden. Prints one line per build, with the
# instruction sets of this processor that were compared.
#
#   scripts/bits.sh [COMPILER-OPTIMISATION …]   default: g++-O0 g++-O2 g++-O3 clang++-O0 clang++-O2
#                                               clang++-O3; clang++ needs the Debian package clang
set -euo pipefail
cd "$(dirname "$0")/.."
builds=("$@")
[ ${#builds[@]} -gt 0 ] || builds=(g++-O0 g++-O2 g++-O3 clang++-O0 clang++-O2 clang++-O3)
scripts/install_dependencies.sh --fuzz
launcher=()
command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

status=0
for build in "${builds[@]}"; do
  folder=build/bits/$build
  mkdir -p "$folder"
  {
    cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release \
      -DCMAKE_CXX_COMPILER="${build%-O*}" -DCMAKE_CXX_FLAGS_RELEASE="-O${build##*-O}" \
      "${launcher[@]}" && cmake --build "$folder" --target crowdface_run_test
  } >"$folder/build.log" 2>&1 || { tail -n 40 "$folder/build.log" >&2; exit 1; }
  result=equal
  "$folder/bin/crowdface_run_test" --gtest_filter='*Golden*' >"$folder/test.log" 2>&1 ||
    result=DIFFERENT
  passed=$(grep -c '^\[       OK' "$folder/test.log" || true)
  [ "$result" != equal ] || [ "$passed" -eq 3 ] || result="INCOMPLETE, expected 3 tests"
  [ "$result" = equal ] || status=1
  sets=$(sed -n 's/^instruction sets: //p' "$folder/test.log" | head -n 1)
  printf '%-12s %s (%s tests passed; %s)\n' "$build" "$result" "$passed" "${sets:-no instruction sets}"
done
exit $status
