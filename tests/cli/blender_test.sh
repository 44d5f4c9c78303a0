#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Blender shows our faces in their shapes as OBJ files have them. Skipped (69) where Blender is not installed.
#   blender_test.sh PROGRAM ROOT
# PICTURES=DIR keeps a picture.
set -euo pipefail
program=$1 root=$2
if ! command -v blender >/dev/null || ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  echo "no Blender: Debian's packages blender and python3-numpy have it" >&2
  exit 69
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" synth -o "$folder/heads" --count 3 --vertices 5000 --quiet
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 2}
faces: {directory: heads, units: cm}
shapes: {neutral: heads/synth_01.obj, directory: heads}
output: {directory: out, meshes: [glb, usd, obj], contact_sheet: none}
YAML
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
for id in mob_0001 mob_0002; do
  blender --background --factory-startup --python-exit-code 1 --python "$root/tests/cli/blender_shapes.py" -- \
    "$folder/out/meshes" "$id" 100 ${PICTURES:+"$PICTURES/$id.png"} >"$folder/log" 2>&1 || {
    cat "$folder/log"
    exit 1
  }
  grep "^$id" "$folder/log"
done
