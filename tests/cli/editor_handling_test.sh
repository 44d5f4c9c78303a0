#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Faces are changed by hand on the page of `crowdface edit`: see gallery/test/handling.mjs. Skipped (77) where there is no
# Chromium or the page was not built.
#   editor_handling_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/heads" --count 5 --vertices 6000 --seed 2 --quiet
write_card
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 4}
faces: {directory: heads, units: cm}
regions: {names: [top, tip, bottom], mask: $root/masks/synth_bands.png}
attachments: {items: [{name: card, kind: hat, file: card.obj, moves: rigid}]}
output: {directory: out, meshes: [points], contact_sheet: {cell: 96}}
YAML
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
serve edit "$folder/config.yaml" --cache "$folder/cache" --no-browser
browse handling.mjs "$address" "$folder/out/renders/mob_0002.png" "${PICTURES-}"
