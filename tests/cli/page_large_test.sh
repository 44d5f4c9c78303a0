#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The gallery of a large crowd shows a page of faces at a time; the program takes the review that it exports.
# Skipped (77) where there is no Chromium or the pages were not built.
#   page_large_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/heads" --count 4 --vertices 6000 --seed 2 --quiet
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 7}
faces: {directory: heads, units: cm}
families: [{name: smith, members: 2, target: synth_03, max_distance: 4 mm}]
output: {directory: out, meshes: [points], faces_per_folder: 3, contact_sheet: {cell: 96}}
YAML
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
browse large.mjs "$folder/out/gallery" "$folder/review.yaml" "${PICTURES-}"
cp "$folder/out/plan.jsonl" "$folder/before.jsonl"
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet --review "$folder/review.yaml"
changed=$(diff "$folder/before.jsonl" "$folder/out/plan.jsonl" | grep -c '^>' || true)
[ "$changed" -ge 1 ] || { echo "the review changed no face"; exit 1; }
"$program" verify "$folder/out" --quiet
