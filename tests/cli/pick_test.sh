#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The page of `crowdface wrap --pick` works in a browser: places are clicked on template and scan, suggested on
# the other half, dragged, taken back, saved; `crowdface wrap` takes the saved file. Skipped (77) where there is no
# Chromium or the page was not built.
#   pick_test.sh PROGRAM ROOT
set -euo pipefail
. "$(dirname "$0")/page.sh"

"$program" synth -o "$folder/heads" --count 2 --vertices 20000 --seed 2 --quiet
template=$folder/heads/synth_01.obj
# A scan of the other head: in millimetres, up along z, far from where the template is, its left half blue.
awk '/^v / { printf "v %.5f %.5f %.5f %s\n", 10 * $2 + 700, -10 * $4, 10 * $3 - 50, ($2 > 0 ? "0.1 0.2 0.9" : "0.7 0.5 0.4") } /^f / { gsub(/\/[0-9\/]*/, ""); print }' \
  "$folder/heads/synth_02.obj" >"$folder/scan.obj"
printf '# picked by hand\ntemplate: {}\n' >"$folder/landmarks.yaml"
serve wrap --pick "$template" "$folder/scan.obj" --landmarks "$folder/landmarks.yaml" --no-browser
before=$(ls "$folder")
browse pick.mjs "$address" "$template" "$folder/scan.obj" "${PICTURES-}"
[ "$(ls "$folder")" = "$before" ] || { echo "something else was written:"; ls "$folder"; exit 1; }
head -n 1 "$folder/landmarks.yaml" | grep -qx '# picked by hand'
"$program" wrap "$template" "$folder/scan.obj" --landmarks "$folder/landmarks.yaml" -o "$folder/head.obj" \
  --no-pictures 2>&1 | tee "$folder/wrap.log"
grep -q ', 10 landmarks' "$folder/wrap.log"
