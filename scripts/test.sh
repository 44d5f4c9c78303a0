#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds and tests; the last lines are ctest's summary.
#
#   scripts/test.sh [CTEST OPTION …]        all but the slow tests, or what options choose: -R Blend
#   scripts/test.sh --all [CTEST OPTION …]  the slow ones too (label `slow`): they disturb whole runs, run
#                                         every example, real heads, or pages at length
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
