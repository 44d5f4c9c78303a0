#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs missing packages, builds and tests; the last lines are ctest's summary.
#
#   scripts/test.sh [CTEST OPTION …]        all tests that are not slow; options select tests: -R Blend
#   scripts/test.sh --all [CTEST OPTION …]  also tests with the label `slow`: disturbed runs, all examples, real
#                                         heads, and long tests of pages
#   PRESET=asan scripts/test.sh             another preset of CMakePresets.json
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${PRESET:-release}
which=(--label-exclude '^slow$')
if [ "${1-}" = --all ]; then
  which=()
  shift
fi

scripts/install_dependencies.sh --test
scripts/build.sh "$preset"
exec ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error "${which[@]}" "$@" </dev/null
