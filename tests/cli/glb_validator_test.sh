#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What the program writes as GLB passes the Khronos validator. Skipped (69) where npm could not
# fetch that.
#   glb_validator_test.sh PROGRAM ROOT
set -euo pipefail
program=$1 root=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" synth -o "$folder/heads" --count 2 --vertices 5000 --textures 64 --quiet
cat >"$folder/config.yaml" <<YAML
schema: 1
crowd: {name: mob, count: 2}
faces: {directory: heads, units: cm}
shapes: {neutral: heads/synth_01.obj, directory: heads}
output: {directory: out, meshes: [glb], contact_sheet: none}
YAML
"$program" generate "$folder/config.yaml" --cache "$folder/cache" --quiet
"$root/scripts/check_glb.sh" "$folder"/out/meshes/*.glb
