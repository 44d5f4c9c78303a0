#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures how far the detected marks of faces (eyes, tip of the nose, mouth) move if the heads are rotated,
# thinned, refined, cut, or get noise. Prints a Markdown table for each folder.
#
#   scripts/measure_marks.sh HEADS_DIR…
#
# HEADS_DIR holds OBJ files in one topology, +Y up, facing +Z.
set -euo pipefail

[ $# -ge 1 ] || { sed -n '/^#   scripts/s/^#   //p' "$0" >&2; exit 64; }
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/build.sh" release crowdface_measure_marks >&2
exec "$root/build/release/bin/crowdface_measure_marks" "$@"
