#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The packed add-on makes, browses and reviews a crowd and wraps a scan. Skipped (69) where Blender is not installed.
#   blender_addon_test.sh PROGRAM ROOT
set -euo pipefail
program=$1 root=$2
if ! command -v blender >/dev/null || ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  echo "no Blender: Debian's packages blender and python3-numpy have it" >&2
  exit 69
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_CACHE_HOME="$folder/cache" BLENDER_USER_SCRIPTS="$folder/scripts" BLENDER_USER_CONFIG="$folder/config"
mkdir -p "$folder/scripts/addons"
"$root/scripts/package_blender.sh" "$folder/addon.zip"
"$program" synth -o "$folder/heads" --count 6 --vertices 5000 --seed 3 --textures 64 --hair --quiet
blender --background --factory-startup --python-exit-code 1 --python "$root/tests/cli/blender_addon.py" -- \
  "$folder" "$program" >"$folder/log" 2>&1 || {
  cat "$folder/log"
  exit 1
}
grep "^test: " "$folder/log"
