#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What the tests of pages in a browser have in common; sourced with PROGRAM and ROOT. Skipped (77) where
# there is no Chromium or the pages were not built. Sets program, root, chromium and page (the built
# pages' folder), makes a temporary folder, and ends all that it starts.
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
stop_server() {
  [ -n "$server" ] || return 0
  kill "$server" 2>/dev/null || true
  wait "$server" 2>/dev/null || true
  server=
}
finish() {
  stop_server
  rm -rf "$folder"
}
trap finish EXIT

# serve ARGUMENTS…: starts the program with them, and sets address to what it prints.
serve() {
  "$program" "$@" >"$folder/server.log" 2>&1 &
  server=$!
  for _ in $(seq 600); do
    address=$(grep -o 'http://127.0.0.1:[0-9]*/[0-9a-f]*/' "$folder/server.log" | head -n 1 || true)
    [ -z "$address" ] || return 0
    kill -0 "$server" 2>/dev/null || break
    sleep 0.1
  done
  cat "$folder/server.log"
  exit 1
}

# browse SCRIPT.mjs ARGUMENTS…: one of gallery/test, in the browser.
browse() {
  for script in open_page.mjs worn_pixels.mjs "$1"; do  # to where their modules are, whole at any moment
    cp "$root/gallery/test/$script" "$root/build/gallery/$$.$script"
    mv "$root/build/gallery/$$.$script" "$root/build/gallery/$script"
  done
  CHROMIUM=$chromium node "$root/build/gallery/$1" "${@:2}" || {
    [ ! -f "$folder/server.log" ] || tail -n 20 "$folder/server.log"
    exit 1
  }
}

# write_card: FOLDER/card.obj, a card before the foreheads of synthetic heads, red on the left and not there on the right.
write_card() {
  base64 -d >"$folder/card.png" <<<iVBORw0KGgoAAAANSUhEUgAAAAQAAAACCAYAAAB/qH1jAAAAE0lEQVR42mN4JiLyH4QZYABdAACr0Ag1VhJR4gAAAABJRU5ErkJggg==
  echo 'newmtl card
map_Kd card.png' >"$folder/card.mtl"
  echo 'mtllib card.mtl
v -4 5 12
v 4 5 12
v 4 9 12
v -4 9 12
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl card
f 1/1 2/2 3/3 4/4' >"$folder/card.obj"
}
