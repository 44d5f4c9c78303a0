#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Synthetic heads have the same bytes on every machine. The last bits of functions such as std::atan2 differ between C
# libraries and processors, so the sources of synthetic heads may not call them.
#   same_on_every_machine.sh ROOT
set -euo pipefail
cd "$1/src/head_models/synth"

functions='sin|cos|tan|asin|acos|atan|atan2|exp|exp2|expm1|log|log2|log10|log1p|pow|cbrt|sinh|cosh|tanh'
if grep -nE "\bstd::($functions)\(" -- *.h *.cpp; then
  echo "expected functions with the same bits on every machine; see smooth_wave in noise.h" >&2
  exit 1
fi
