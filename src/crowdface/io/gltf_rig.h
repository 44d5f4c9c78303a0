// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/io/glb_skin.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The joints and skinned meshes of a glTF 2.0 file in the rest pose, in metres, with +Y up and +Z
/// to the front.
struct GltfRig {
  /// A joint of the skeleton.
  struct Joint {
    std::string name;
    std::uint32_t parent;  ///< index of the parent in `joints`; kNoIndex: no parent
    /// Transform from the joint's axes to the file's axes in the rest pose.
    Eigen::Matrix4d rest_transform;
  };
  std::vector<Joint> joints;
  Positions positions;  ///< vertices of all meshes, one mesh after the other
  /// the value of `_VERTEX_ID` of each vertex; empty if the file lacks this attribute
  std::vector<std::uint32_t> vertex_ids;
  /// Row i: the joints that move vertex i, and their weights.
  CompressedRows<Influence> influences;
};

/// Reads a GLB file. A mesh without a skin counts as rigidly bound to its parent joint.
/// \throws MissingInput if there is no such file; InvalidInput if the file is not GLB, has no
///         joints, has a mesh that is not below a joint, or stores JOINTS_n or WEIGHTS_n with a
///         component type that glTF does not allow.
GltfRig read_gltf_rig(const std::filesystem::path& path);

}  // namespace crowdface
