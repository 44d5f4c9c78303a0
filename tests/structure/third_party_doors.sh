#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Each third-party library is included by the modules that own it and by no other (docs/
# architecture.md): behind one door it can be replaced, and its quirks are known in one place.
#   third_party_doors.sh ROOT
set -euo pipefail
cd "$1/src"

status=0
# door PATTERN MODULE…: includes that match stand in .cpp files of these modules only.
door() {
  local pattern=$1 found
  shift
  local allowed
  allowed=$(IFS='|'; echo "$*")
  found=$(grep -rnE "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($pattern)" . |
    grep -vE "^\./($allowed)" || true)
  [ -z "$found" ] && return
  echo "expected only in: $*"
  echo "$found"
  status=1
}

door 'tbb/|oneapi/tbb' 'crowdface/core/[a-z_]*\.cpp'
door 'spdlog/' 'crowdface/core/[a-z_]*\.cpp'
door 'xxhash' 'crowdface/core/[a-z_]*\.cpp'
door 'Random123/' 'crowdface/core/[a-z_]*\.cpp'
door 'hwy/' 'crowdface/core/fused_lanes-inl\.h' 'crowdface/core/[a-z_]*\.cpp' \
  'crowdface/smooth/[a-z_]*_kernels\.cpp' 'crowdface/blend/[a-z_]*_kernels\.cpp' \
  'crowdface/(render/(front_quads|visibility_filter|shading)|validity/leaf_boxes)\.cpp' 'crowdface/(cast|texture)/[a-z_]*_kernels\.cpp'
door 'tiny_obj_loader' 'crowdface/io/[a-z_]*\.cpp'
door 'OpenImageIO/' 'crowdface/io/openimageio_codec\.cpp'
door 'png\.h' 'crowdface/io/png_codec\.cpp'
door 'ft2build|freetype' 'crowdface/render/text_label\.cpp'
door 'embree' 'crowdface/render/ray_scene\.cpp'
door 'meshoptimizer' 'crowdface/preview/[a-z_]*\.cpp' 'crowdface/io/gltf_compression\.cpp'
door 'assimp/' 'crowdface/io/assimp_reader\.cpp'
door 'draco/' 'crowdface/io/gltf_compression\.cpp'
door 'yaml-cpp/' 'crowdface/config/[a-z_]*\.cpp'
door 'nlohmann/' 'crowdface/(io/shallow_json|io/glb_part|io/glb_scene|io/glb_skin|crowd/(face_json|ledger)|pictures/change_choices|run/(casting_report|planned|report))\.h' \
  '(crowdface/(io|wrap|crowd|pictures|run)|head_models/morph)/[a-z_]*\.cpp' 'crowdface/(editor|page|pick)/[a-z_]*\.(cpp|h)'
door 'CLI/' 'cli/(command_line|main)\.cpp'
exit $status
