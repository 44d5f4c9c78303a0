#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The gallery and the editor know bands of detail and mirrored faces; a mirrored face that the editor saves
# is the one that `crowdface blend` makes of its recipe. Skipped (77) where there is no Chromium or the
# pages were not built.
#   page_bands_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/heads" --count 4 --vertices 6000 --seed 2 --quiet
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 6}
faces: {directory: heads, units: cm}
regions: {names: [top, middle, bottom], mask: $root/masks/synth_bands.png}
blending: {contacts: none}
sampling: {mirror: drawn, bands: {build: 0.7, skin: {smoothness: 0.1, extrapolation: [0.9, 1.1]}}}
output: {directory: out, meshes: [points], contact_sheet: {cell: 96}}
YAML
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
serve edit "$folder/config.yaml" --cache "$folder/cache" --no-browser
browse bands.mjs "$folder/out/gallery" "$address" "$folder/result.json"
saved=$folder/out/edited/an_image.obj
node "$root/gallery/test/compare_points.mjs" "$folder/result.json" "$saved" 0.01
grep -q '"mirrored":true' "$folder/out/edited/edited.jsonl"
"$program" blend "$folder/config.yaml" --cache "$folder/cache" \
  --recipe "$folder/out/edited/edited.jsonl#an_image" -o "$folder/again.obj" --quiet
cmp "$saved" "$folder/again.obj"
