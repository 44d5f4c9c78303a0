#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds and runs every test; the last lines are ctest's summary.
#
#   scripts/test.sh [CTEST OPTION …]        such as: scripts/test.sh -R Blend
#   PRESET=asan scripts/test.sh             another preset of CMakePresets.json
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${PRESET:-release}

scripts/install_dependencies.sh --test
scripts/build.sh "$preset"
exec ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error "$@" </dev/null
