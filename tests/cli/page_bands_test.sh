#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The gallery and the editor know bands of detail and mirrored faces; a mirrored face that the editor saves
# is the one that `crowdface blend` makes of its recipe. Skipped (77) where there is no Chromium or the
# pages were not built.
#   page_bands_test.sh PROGRAM ROOT
set -euo pipefail
program=$1 root=$2
skip() {
  echo "SKIPPED: $1"
  exit 77
}
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
[ -n "$chromium" ] || skip "no Chromium: scripts/install_dependencies.sh --test installs it"
command -v node >/dev/null || skip "no node"
page=$(dirname "$(dirname "$program")")/share/crowdface/gallery
[ -f "$page/editor.js" ] || skip "the pages were not built: scripts/build_gallery.sh"
[ -d "$root/build/gallery/node_modules/playwright-core" ] || skip "playwright-core is not installed"

folder=$(mktemp -d)
server=
stop() {
  if [ -n "$server" ]; then
    kill "$server" 2>/dev/null || true
    wait "$server" 2>/dev/null || true
  fi
  rm -rf "$folder"
}
trap stop EXIT
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
"$program" edit "$folder/config.yaml" --cache "$folder/cache" --no-browser >"$folder/edit.log" 2>&1 &
server=$!
for _ in $(seq 600); do
  address=$(grep -o 'http://127.0.0.1:[0-9]*/[0-9a-f]*/' "$folder/edit.log" | head -n 1 || true)
  [ -z "$address" ] || break
  kill -0 "$server" 2>/dev/null || { cat "$folder/edit.log"; exit 1; }
  sleep 0.1
done
[ -n "$address" ] || { cat "$folder/edit.log"; exit 1; }
cp "$root/gallery/test/bands.mjs" "$root/gallery/test/compare_points.mjs" "$root/build/gallery/"
CHROMIUM=$chromium node "$root/build/gallery/bands.mjs" "$folder/out/gallery" "$address" "$folder/result.json" || {
  tail -n 20 "$folder/edit.log"
  exit 1
}
saved=$folder/out/edited/an_image.obj
node "$root/build/gallery/compare_points.mjs" "$folder/result.json" "$saved" 0.01
grep -q '"mirrored":true' "$folder/out/edited/edited.jsonl"
"$program" blend "$folder/config.yaml" --cache "$folder/cache" \
  --recipe "$folder/out/edited/edited.jsonl#an_image" -o "$folder/again.obj" --quiet
cmp "$saved" "$folder/again.obj"
