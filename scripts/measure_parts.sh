#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures the fit of eyes and teeth in heads, in a crowd with parts, and in the same crowd with all parts blended
# as skin. Builds the programs, paints a mask of three bands, makes both crowds, and prints the table of
# docs/parts.md and the time that blending took in each crowd.
#
#   scripts/measure_parts.sh HEADS_DIR [WORK_DIR]
#
# HEADS_DIR holds OBJ files in centimetres, +Y up, facing +Z, with eyes and teeth. Masks, config, meshes and
# a sheet of eight faces of each crowd are kept in WORK_DIR (default out/measure_parts).
set -euo pipefail

[ $# -ge 1 ] || { sed -n '/^#   scripts/s/^#   //p' "$0" >&2; exit 64; }
root=$(cd "$(dirname "$0")/.." && pwd)
heads=$(cd "$1" && pwd)
work=${2:-$root/out/measure_parts}
mkdir -p "$work"
work=$(cd "$work" && pwd)
"$root/scripts/build.sh" release crowdface crowdface_measure_parts
bin=$root/build/release/bin

"$bin/crowdface_measure_parts" --bands "$heads" "$work/bands"
cat >"$work/crowd.yaml" <<END
schema: 1
crowd: {name: ict, count: 100, seed: 20261121}
faces: {directory: $heads, units: cm}
regions: {names: [top, middle, bottom], mask: bands.<UDIM>.png}
sampling: {smoothness: [0.1, 0.6], extrapolation: [0.9, 1.2], max_sources: 4}
believability: {meshes: none}
output:
  directory: crowd
  meshes: [obj]
  contact_sheet: {columns: 4, rows: 2, cell: 360}
  gallery: none
END

"$bin/crowdface" prepare "$work/crowd.yaml" --quiet
rm -rf "$work"/{,sheet_}{none,auto} # an earlier program may have made them
for parts in none auto; do
  for sheet in sheet none; do
    options=(--set "parts=$parts" --force --quiet)
    if [ "$sheet" = none ]; then
      options+=(--set output.contact_sheet=none --out "$work/$parts")
    else
      options+=(--set crowd.count=8 --out "$work/sheet_$parts")
    fi
    "$bin/crowdface" generate "$work/crowd.yaml" "${options[@]}"
  done
  echo "parts: $parts: $(tr -d '\n' <"$work/$parts/timings.json" | grep -o '"blend[^,}]*' | head -n 1)"
done
"$bin/crowdface_measure_parts" "$heads" "$work/none" "$work/auto"
