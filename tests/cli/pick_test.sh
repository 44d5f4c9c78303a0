#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The page of `crowdface wrap --pick` works in a browser: places are clicked on template and scan, suggested on
# the other half, dragged, taken back, saved; `crowdface wrap` takes the saved file. Skipped (77) where there is no
# Chromium or the page was not built.
#   pick_test.sh PROGRAM ROOT
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
[ -f "$page/pick.js" ] || skip "the page was not built: scripts/build_gallery.sh"
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
"$program" synth -o "$folder/heads" --count 2 --vertices 20000 --seed 2 --quiet
template=$folder/heads/synth_01.obj
# A scan of the other head: in millimetres, up along z, far from where the template is.
awk '/^v / { printf "v %.5f %.5f %.5f\n", 10 * $2 + 700, -10 * $4, 10 * $3 - 50 } /^f / { gsub(/\/[0-9\/]*/, ""); print }' \
  "$folder/heads/synth_02.obj" >"$folder/scan.obj"
printf '# picked by hand\ntemplate: {}\n' >"$folder/landmarks.yaml"
"$program" wrap --pick "$template" "$folder/scan.obj" --landmarks "$folder/landmarks.yaml" --no-browser \
  >"$folder/pick.log" 2>&1 &
server=$!
for _ in $(seq 300); do
  address=$(grep -o 'http://127.0.0.1:[0-9]*/[0-9a-f]*/' "$folder/pick.log" | head -n 1 || true)
  [ -z "$address" ] || break
  kill -0 "$server" 2>/dev/null || { cat "$folder/pick.log"; exit 1; }
  sleep 0.1
done
[ -n "$address" ] || { cat "$folder/pick.log"; exit 1; }
before=$(ls "$folder")
cp "$root/gallery/test/pick.mjs" "$root/build/gallery/"
CHROMIUM=$chromium node "$root/build/gallery/pick.mjs" "$address" "$template" "$folder/scan.obj" "${PICTURES-}" || {
  tail -n 20 "$folder/pick.log"
  exit 1
}
[ "$(ls "$folder")" = "$before" ] || { echo "something else was written:"; ls "$folder"; exit 1; }
head -n 1 "$folder/landmarks.yaml" | grep -qx '# picked by hand'
"$program" wrap "$template" "$folder/scan.obj" --landmarks "$folder/landmarks.yaml" -o "$folder/head.obj" \
  --no-pictures 2>&1 | tee "$folder/wrap.log"
grep -q ', 10 landmarks' "$folder/wrap.log"
