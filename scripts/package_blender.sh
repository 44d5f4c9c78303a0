#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Packs the Blender add-on as one zip file: package_blender.sh [FILE.zip]
set -euo pipefail
file=$(realpath -m "${1:-crowdface_blender.zip}")
cd "$(dirname "$0")/../blender"
cmake -E tar cf "$file" --format=zip crowdface_blender/*.py crowdface_blender/blender_manifest.toml
echo "$file"
