#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Readers of others make of our USD layers what NumPy files hold of the same faces. Skipped (69) where npm could not
# fetch them.
#   usd_reader_test.sh PROGRAM ROOT
set -euo pipefail
program=$1 root=$2
modules=$root/build/gallery/node_modules
if ! command -v node >/dev/null || [ ! -d "$modules/tinyusdz" ]; then
  echo "no readers of USD: scripts/build_gallery.sh fetches them, with npm from its registry" >&2
  exit 69
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" synth -o "$folder/heads" --count 2 --vertices 5000 --textures 64 --quiet
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 3}
faces: {directory: heads, units: cm}
shapes: {neutral: heads/synth_01.obj, directory: heads}
output: {directory: out, meshes: [usd, points], contact_sheet: none}
YAML
for lods in '[]' '[40 %, 10 %]'; do
  "$program" generate "$folder/config.yaml" --set "output.lods=$lods" --out "$folder/out" \
    --cache "$folder/cache" --force --quiet
  node "$root/tests/cli/read_usd.mjs" "$folder/out" "$modules"
done

# What faces wear stands in their layers, too.
"$program" synth -o "$folder/dressed" --count 4 --vertices 5000 --textures 64 --hair --quiet
"$program" init "$folder/dressed" -o "$folder/dressed.yaml" --quiet
"$program" generate "$folder/dressed.yaml" --set "output.meshes=[usd, points]" --set crowd.count=4 \
  --set "shapes={neutral: dressed/synth_01.obj, directory: dressed}" \
  --set output.contact_sheet=none --out "$folder/worn" --cache "$folder/cache" --quiet
grep -q '_materials"' "$folder"/worn/meshes/*.usda
node "$root/tests/cli/read_usd.mjs" "$folder/worn" "$modules"
