#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The page of `crowdface edit` has no traps: see gallery/test/traps.mjs. Skipped (77) where there is no Chromium or
# the page was not built.
#   editor_traps_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/heads" --count 5 --vertices 6000 --seed 2 --quiet
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 4}
faces: {directory: heads, units: cm}
regions: {names: [top, tip, bottom], mask: $root/masks/synth_bands.png}
output: {directory: out, meshes: [points], contact_sheet: {cell: 96}}
YAML
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
serve edit "$folder/config.yaml" --cache "$folder/cache" --no-browser
browse traps.mjs "$address" "${PICTURES-}"
