// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "crowdface/core/error.h"
#include "crowdface/io/gltf_rig.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const crowdface::fuzz::InputFile file(data, size);
    const crowdface::GltfRig rig = crowdface::read_gltf_rig(file.path());
    const auto points = static_cast<std::size_t>(rig.positions.rows());
    if (!rig.positions.allFinite()) std::abort();
    if (rig.influences.group_count() != points) std::abort();
    for (const crowdface::Influence& one : rig.influences.items) {
      if (one.joint >= rig.joints.size() || !(one.weight >= 0 && one.weight <= 1)) std::abort();
    }
    for (const crowdface::GltfRig::Joint& joint : rig.joints) {
      if (joint.parent != crowdface::kNoIndex && joint.parent >= rig.joints.size()) std::abort();
    }
  } catch (const crowdface::Error&) {
  }
  return 0;
}
