#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How well `crowdface wrap` finds heads again (the table of docs/wrap.md): heads of the ICT face model become
# scans, and are wrapped by one other head, by the mean of all others and by a model of all others. Errors
# against the heads' own vertices in mm, median / 95 %.
#
#   scripts/measure_wrap.sh HEADS_DIR [HEAD …] [--templates one,mean,model] [--estimate]
#                           [--landmarks picked|found|none] [--next N]
#
# HEADS_DIR holds OBJ files in centimetres in the model's topology; HEAD counts from 0 (default: 0 4 5 9 10).
# Without picked landmarks, the scans are one surface with the eyes, and the detected landmarks, the agreement of
# features and the warnings are printed. N: the template "one" is the head N after the scanned head.
set -euo pipefail

[ $# -ge 1 ] || { sed -n '/^#   scripts/s/^#   //p' "$0" >&2; exit 64; }
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/build.sh" release crowdface_measure_wrap >&2
exec "$root/build/release/bin/crowdface_measure_wrap" "$@"
