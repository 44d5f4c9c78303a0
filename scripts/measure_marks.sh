#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How far the marks of faces (eyes, tip of the nose, mouth) move if their heads are rotated, thinned,
# refined, noisy or cut: a table in Markdown for each folder.
#
#   scripts/measure_marks.sh HEADS_DIR…
#
# HEADS_DIR holds OBJ files in one topology, +Y up, facing +Z.
set -euo pipefail

[ $# -ge 1 ] || { sed -n '/^#   scripts/s/^#   //p' "$0" >&2; exit 64; }
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/build.sh" release crowdface_measure_marks >&2
exec "$root/build/release/bin/crowdface_measure_marks" "$@"
