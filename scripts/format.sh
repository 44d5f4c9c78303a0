#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Formats every source file in place (.clang-format).
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh --check
git ls-files -z --cached --others --exclude-standard -- 'src/*.h' 'src/*.cpp' 'tests/*.h' \
  'tests/*.cpp' 'examples/*.cpp' 'python/*.h' 'python/*.cpp' | xargs -0 --no-run-if-empty clang-format -i
