#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What the editor's page computes itself: weights, coefficients, blends, steps. Skipped (77) where there
# is no node or the page was not built.
#   editor_mathematics_test.sh ROOT
set -euo pipefail
root=$1
command -v node >/dev/null || { echo "SKIPPED: no node"; exit 77; }
[ -d "$root/build/gallery/src/editor" ] || { echo "SKIPPED: the pages were not built: scripts/build_gallery.sh"; exit 77; }
cp "$root/gallery/test/recipe_test.mjs" "$root/build/gallery/recipe_test.mjs"
node --test "$root/build/gallery/recipe_test.mjs"
