#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures the errors of `crowdface wrap` (the table of docs/wrap.md). The scans are heads of the ICT face model. The
# templates are another head, the mean of all other heads, and a shape model of all other heads. Errors are distances
# from the scanned head's own vertices in mm: median / 95th percentile.
#
#   scripts/measure_wrap.sh HEADS_DIR [HEAD …] [--templates one,mean,model] [--estimate]
#                           [--landmarks picked|found|none] [--next N]
#
# HEADS_DIR holds OBJ files in centimetres in the model's topology; HEAD counts from 0 (default: 0 4 5 9 10).
# Without picked landmarks, skin and eyes of a scan are one surface, and the script prints the detected landmarks, the
# correlation of features and the warnings. N: the template "one" is the head N after the scanned head.
set -euo pipefail

[ $# -ge 1 ] || { sed -n '/^#   scripts/s/^#   //p' "$0" >&2; exit 64; }
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/build.sh" release crowdface_measure_wrap >&2
exec "$root/build/release/bin/crowdface_measure_wrap" "$@"
