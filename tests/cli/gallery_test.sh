#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A crowd's gallery works in a browser, opened from disk: load, filter, open, turn, mark, export; the
# program takes the exported review and draws anew what it rejects, and nothing else. Skipped (77)
# where there is no Chromium or the page was not built; scripts/test.sh sees to both.
#   gallery_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/heads" --count 5 --vertices 20000 --seed 2 --textures 256 --quiet
mkdir -p "$folder/template/shapes"
cp "$folder/heads/synth_01.obj" "$folder/template/neutral.obj"
awk '/^v / && $3 > 1 && $3 < 5 && $4 > 6 { $3 += 0.5 } { print }' "$folder/template/neutral.obj" >"$folder/template/shapes/browUp.obj"
write_card
# Under the skin of a brow: it is to move and not to be seen.
awk '/^v / && $2 > 1 && $2 < 3 && $3 > 2 && $3 < 4 && $4 > 6 { print $1, $2, $3, $4 - 0.2; n++ } n == 3 { exit }
  END { print "f 1 2 3" }' "$folder/template/neutral.obj" >"$folder/tuft.obj"
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 7}
faces: {directory: heads, units: cm, tags: {synth_01: [old], synth_02: [young]}}
regions: {names: [top, middle, bottom], mask: $root/masks/synth_bands.png}
traits: {nose_width: {}, facial_index: {}}
recipes: [{id: by_hand, target: synth_01, regions: {all: {weights: {synth_02: 1}}}}]
families: [{name: smith, members: 2, target: synth_03, max_distance: 4 mm}]
attachments: {items: [{name: card, kind: hat, file: card.obj, moves: rigid}, {name: tuft, kind: brows, file: tuft.obj}]}
shapes: {neutral: template/neutral.obj, directory: template/shapes}
output: {directory: out, meshes: [points], contact_sheet: {cell: 96, views: [front, profile]}}
YAML
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
gallery=$folder/out/gallery

# 300 faces stay under 70 MB, with small pictures on them; those beside them are not counted.
largest=$(stat -c %s "$gallery/data/faces"/*.js | sort -n | tail -n 1)
echo "$largest bytes a face"
[ "$largest" -lt 230000 ] || { echo "a face's mesh takes $largest bytes"; exit 1; }

browse browser.mjs "$gallery" "$folder/review.yaml" "${PICTURES-}"
cat "$folder/review.yaml"
cp "$folder/out/plan.jsonl" "$folder/before.jsonl"
"$program" plan "$folder/config.yaml" --cache "$folder/cache" --quiet --review "$folder/review.yaml"
changed=$(diff "$folder/before.jsonl" "$folder/out/plan.jsonl" | grep -c '^>' || true)
[ "$changed" -eq 4 ] || { echo "expected 2 faces drawn anew, an older one and a variant, found $changed"; exit 1; }
[ "$(grep -c '"changed":\["review 1: age"\]' "$folder/out/plan.jsonl")" -eq 1 ] || { echo "nobody got older"; exit 1; }
[ "$(grep -c '"changed":\["review 1: variant_of"\]' "$folder/out/plan.jsonl")" -eq 1 ] || { echo "no variant"; exit 1; }
grep -q 'too like \\"0007\\": chin, #2 {nose}' "$folder/out/plan.jsonl" || {
  echo "the note did not reach the plan"
  exit 1
}
