// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/core/grouped.h"
#include "crowdface/io/glb_skin.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Joints and the meshes bound to them, as a glTF 2.0 file has them at rest: metres, +Y up, +Z front.
struct GltfRig {
  struct Joint {
    std::string name;
    std::uint32_t parent;  ///< kNoIndex: it has none
    Eigen::Matrix4d rest;  ///< to the file's axes
  };
  std::vector<Joint> joints;
  Positions points;                       ///< of all meshes' vertices, one after the other
  std::vector<std::uint32_t> vertex_ids;  ///< #points, of the attribute `_VERTEX_ID`; empty without
  Grouped<Influence> influences;          ///< #points
};

/// Reads a GLB file. A mesh that is not skinned counts as bound to the joint it hangs on.
/// \throws InvalidInput if it is none, has no joints, a mesh that hangs on none, or accessors of kinds that
///         JOINTS_n and WEIGHTS_n cannot be; MissingInput.
GltfRig read_gltf_rig(const std::filesystem::path& path);

}  // namespace crowdface
