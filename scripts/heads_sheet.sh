#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders a contact sheet of a folder of heads (2 to 50 OBJ files in centimetres, +Y up, facing +Z), without
# making a crowd.
#
#   scripts/heads_sheet.sh HEADS_DIR SHEET.png [COLUMNS] [CELL_PX] [VIEWS]
#   scripts/heads_sheet.sh out/demo_heads out/heads.png 4 256 "front, profile"
set -euo pipefail

[ $# -ge 2 ] || { sed -n '/^#   scripts/s/^#   //p' "$0" >&2; exit 64; }
heads=$(realpath "$1") sheet=$2 columns=${3:-4} cell=${4:-256} views=${5:-front}
program=$(cd "$(dirname "$0")/.." && pwd)/build/release/bin/crowdface
[ -x "$program" ] || { echo "heads_sheet: build first, scripts/build.sh release crowdface" >&2; exit 69; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
texture=false
if grep -qs '^map_Kd' "$heads"/*.mtl; then texture=true; fi
names=()
for file in "$heads"/*.obj; do names+=("$(basename "$file" .obj)"); done

# A face equals its target if the target is also its only source.
{
  echo "schema: 1"
  echo "crowd: {name: $(basename "$heads"), count: 0}"
  echo "faces: {directory: '$heads', units: cm, align: none}"
  echo "smoothing: {max_iterations: 1}"
  echo "recipes:"
  for name in "${names[@]}"; do
    echo "  - {id: $name, target: $name," \
      "regions: {all: {weights: {$name: 1}, iterations: 0, extrapolation: 1}}}"
  done
  echo "output:"
  echo "  directory: '$work/sheet'"
  echo "  meshes: []"
  echo "  contact_sheet: {columns: $columns, rows: $(((${#names[@]} + columns - 1) / columns))," \
    "cell: $cell, views: [$views], texture: $texture}"
} >"$work/sheet.yaml"
"$program" generate "$work/sheet.yaml" --quiet --cache "$work/cache"
mkdir -p "$(dirname "$sheet")"
cp "$work/sheet/sheets/sheet_001.png" "$sheet"
