#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Regions are proposed, added, painted, used and removed on the editor's page; what was painted and not
# used is there after the program was killed; the crowd that is generated then has these regions.
#   page_regions_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/heads" --count 4 --vertices 6000 --seed 2 --quiet
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 4} # small
faces: {directory: heads, units: cm}
output: {directory: out, meshes: [points], contact_sheet: {cell: 96}}
YAML
serve edit "$folder/config.yaml" --cache "$folder/cache" --no-browser
browse regions.mjs "$address" use "${PICTURES-}"
grep -q '# small' "$folder/config.yaml"
kill -9 "$server"
wait "$server" 2>/dev/null || true
rm "$folder/out/edited/.address"
serve edit "$folder/config.yaml" --cache "$folder/cache" --no-browser
browse regions.mjs "$address" again "${PICTURES-}"
stop_server
grep -q 'names: \[brow, nose, mouth, ears\]' "$folder/config_edits.yaml"
"$program" verify "$folder/out" --quiet
"$program" check "$folder/config.yaml" --cache "$folder/cache" --quiet >/dev/null
