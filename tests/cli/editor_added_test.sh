#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Heads are dropped on the page of `crowdface edit`, and faces act: see gallery/test/added.mjs. Skipped (77) where there
# is no Chromium or the page was not built.
#   editor_added_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/all" --count 5 --vertices 6000 --textures 128 --seed 2 --quiet
mkdir -p "$folder/heads" "$folder/template/shapes"
cp -r "$folder/all/." "$folder/heads"
rm -rf "$folder/heads"/synth_05*
cp "$folder/all/synth_01.obj" "$folder/template/neutral.obj"
awk '/^v / && $3 > 1 && $3 < 5 && $4 > 6 { $3 += 0.5 } { print }' "$folder/template/neutral.obj" >"$folder/template/shapes/browUp.obj"
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 2}
faces: {directory: heads, units: cm}
regions: {names: [top, tip, bottom], mask: $root/masks/synth_bands.png}
shapes: {neutral: template/neutral.obj, directory: template/shapes}
output: {directory: out, meshes: [points], contact_sheet: {cell: 96}}
YAML
cp "$folder/config.yaml" "$folder/as_it_was.yaml"
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
before=$(cd "$folder/heads" && find . -type f -exec cksum {} + | sort)
serve edit "$folder/config.yaml" --cache "$folder/cache" --no-browser
browse added.mjs "$address" "$folder/all" "${PICTURES-}"
stop_server

# The heads' folder is as it was; the config names the added head, and a crowd is made with it.
[ "$(cd "$folder/heads" && find . -type f -exec cksum {} + | sort)" = "$before" ] || { ls -R "$folder"; exit 1; }
grep -q 'also: \[added/synth_05/synth_05.obj\]' "$folder/config_edits.yaml"
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --force --quiet
grep -q synth_05 "$folder/out/plan.jsonl" || { echo "the added head lends nothing"; exit 1; }
# What was saved under an expression is at rest, as blend makes it.
"$program" blend "$folder/as_it_was.yaml" --cache "$folder/cache" --recipe "$folder/out/edited/edited.jsonl#acting" \
  -o "$folder/again.obj" --quiet
cmp "$folder/out/edited/acting.obj" "$folder/again.obj"
