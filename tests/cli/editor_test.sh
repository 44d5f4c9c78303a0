#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The page of `crowdface edit` works in a browser: drag, slide, type, undo, compare, draw, reload, save;
# the mesh that it saves is the one that `crowdface blend` makes of the saved recipe, and the one on the
# screen. Skipped (77) where there is no Chromium or the page was not built.
#   editor_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/heads" --count 5 --vertices 20000 --textures 256 --seed 2 --quiet
write_card
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 4}
faces: {directory: heads, units: cm, tags: {synth_01: [old], synth_02: [young]}}
regions: {names: [top, middle, bottom], mask: $root/masks/synth_bands.png}
attachments: {items: [{name: card, kind: hat, file: card.obj, moves: rigid}]}
blending: {contacts: none} # as the preview, which is compared with the whole
recipes: # a comment
  - {id: by_hand, target: synth_01, regions: {all: {position: [0.2, 0.3], smoothness: 0.5}}}
output: {directory: out, meshes: [points], contact_sheet: {cell: 96}}
YAML
cp "$folder/config.yaml" "$folder/as_it_was.yaml"
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
serve edit "$folder/config.yaml" --cache "$folder/cache" --no-browser

browse editor.mjs "$address" "$folder/result.json" "${PICTURES-}"

# The saved mesh is what the program makes of the saved recipe, and what was on the screen.
saved=$folder/out/edited/made_by_hand.obj
[ -f "$saved" ] || { echo "no mesh in $saved"; exit 1; }
node "$root/gallery/test/compare_points.mjs" "$folder/result.json" "$saved" 0.01
"$program" blend "$folder/config.yaml" --cache "$folder/cache" \
  --recipe "$folder/out/edited/edited.jsonl#made_by_hand" -o "$folder/again.obj" --quiet
cmp "$saved" "$folder/again.obj"

# What was put back: the recipe beside the one that was there; the review takes effect.
grep -q '^edits: config_edits.yaml' "$folder/config.yaml"
"$program" check "$folder/config.yaml" --cache "$folder/cache" --quiet >/dev/null
grep -q 'made_by_hand' "$folder/config_edits.yaml"
cp "$folder/out/plan.jsonl" "$folder/before.jsonl"
"$program" plan "$folder/as_it_was.yaml" --cache "$folder/cache" --quiet --review "$folder/out/edited/review.yaml"
grep -q "  mob_0002: {colours: {synth_0.: 1}, variant_of: mob_0001" "$folder/out/edited/review.yaml" ||
  { cat "$folder/out/edited/review.yaml"; exit 1; }
changed=$(diff "$folder/before.jsonl" "$folder/out/plan.jsonl" | grep -c '^<' || true)
[ "$changed" -eq 2 ] || { echo "expected 1 face drawn anew and 1 changed, found $changed"; exit 1; }
grep -q 'the chin: é \\"so\\"' "$folder/out/plan.jsonl" || { echo "the note did not reach the plan"; exit 1; }
