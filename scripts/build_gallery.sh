#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fetches the packages of gallery/package.json (including packages for tests), and bundles the pages in gallery/
# with three.js for the program of a preset. Prints nothing if nothing has changed since the last run. Needs node
# and npm.
#
#   scripts/build_gallery.sh PRESET      into build/PRESET/share/crowdface/gallery
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:?"usage: scripts/build_gallery.sh PRESET"}
work=build/gallery
place=build/$preset/share/crowdface/gallery

fetched() {
  cmp -s gallery/package-lock.json "$work/package-lock.json" && [ -d "$work/node_modules/three" ]
}
state=$(cat gallery/package*.json gallery/build.mjs gallery/*.html gallery/src/*.* gallery/src/*/* | cksum)
fetched && [ -f "$place/editor.js" ] && [ -f "$place/pick.js" ] && [ "$(cat "$place/.state" 2>/dev/null)" = "$state" ] && exit 0
command -v node >/dev/null && command -v npm >/dev/null || {
  echo "node and npm are needed for the gallery: apt-get install nodejs npm" >&2
  exit 69
}

mkdir -p "$work"
log=$work/build.log
if ! fetched; then
  cp gallery/package.json gallery/package-lock.json "$work/"
  npm ci --silent --no-audit --no-fund --ignore-scripts --prefix "$work" >"$log" 2>&1 </dev/null || {
    rm -f "$work/package-lock.json"
    tail -n 20 "$log" >&2
    echo "npm could not fetch what the gallery needs" >&2
    exit 69
  }
fi
rm -rf "$work/src"
cp -r gallery/package.json gallery/build.mjs gallery/*.html gallery/src "$work/"
node "$work/build.mjs" "$place"
echo "$state" >"$place/.state"
echo "pages of gallery and editor in $place"
