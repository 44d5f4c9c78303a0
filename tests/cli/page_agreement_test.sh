#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The 3D views of the gallery and of the editor show faces in the colours of the sheet's renders. Skipped (77) where there is no Chromium or
# the page was not built.
#   page_agreement_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/heads" --count 5 --vertices 12000 --seed 2 --textures 512 --hair --quiet
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 4}
faces: {directory: heads, units: cm}
attachments: {from: heads/attachments}
output: {directory: out, meshes: [glb], contact_sheet: {cell: 512}}
YAML
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
serve edit "$folder/config.yaml" --cache "$folder/cache" --no-browser
browse agreement.mjs "$folder/out/gallery" 4 2 "${PICTURES-}" "$address"
