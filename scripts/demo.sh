#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes a first crowd from a fresh checkout: installs missing packages, builds, makes sixteen synthetic heads and
# generates 24 faces from them. May be run again at any time.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_dependencies.sh
scripts/build.sh release crowdface

start=$SECONDS
crowdface=build/release/bin/crowdface
# --force replaces the demo's folders after a change of the program or of configs/demo.yaml.
"$crowdface" synth -o out/demo_heads --count 16 --vertices 20000 --seed 1 --textures 1024 --hair --body --force
"$crowdface" generate configs/demo.yaml --force

echo
echo "24 new faces from 16 heads in $((SECONDS - start)) s"
[ ! -f out/demo/gallery/index.html ] || echo "  gallery        $PWD/out/demo/gallery/index.html"
echo "  contact sheet  $PWD/out/demo/sheets/sheet_001.png"
echo "  meshes         $PWD/out/demo/meshes/"
echo "  recipes        $PWD/out/demo/plan.jsonl"
echo "Change configs/demo.yaml and run this again, or bring your own heads: docs/own-scans.md"
