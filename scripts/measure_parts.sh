#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How eyes and teeth sit in heads, in a crowd whose parts follow and in the same crowd blended as skin:
# builds what it needs, makes both crowds, prints the table of docs/parts.md.
#
#   scripts/measure_parts.sh CONFIG HEADS_DIR [WORK_DIR]
#
# CONFIG names the heads of HEADS_DIR (OBJ files in centimetres, +Y up, facing +Z), without a key
# `parts`. Meshes and pictures of both crowds stay in WORK_DIR (default out/measure_parts).
set -euo pipefail

[ $# -ge 2 ] || { sed -n '/^#   scripts/s/^#   //p' "$0" >&2; exit 64; }
config=$1 heads=$2 work=${3:-out/measure_parts}
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/scripts/build.sh" release crowdface crowdface_measure_parts
for parts in none auto; do
  "$root/build/release/bin/crowdface" generate "$config" --force --quiet --set "parts=$parts" \
    --out "$work/$parts"
done
"$root/build/release/bin/crowdface_measure_parts" "$heads" "$work/none" "$work/auto"
