// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Weight of a joint for one vertex.
struct Influence {
  std::uint32_t joint;  ///< index of the joint in the rig's list of joints
  float weight;         ///< weight of the joint; the weights of a vertex add up to one
};

/// A joint of the rig. All files share the joint; only its position differs from face to face.
struct GlbJoint {
  std::string name;
  std::uint32_t parent;      ///< index of the parent joint; kNoIndex: no parent
  Eigen::Matrix3d rotation;  ///< rotation from the joint's axes to the axes of the face's positions
};

/// The joints below a face's node, and the joints' weights for the face's vertices.
struct GlbSkin {
  std::vector<GlbJoint> joints;  ///< all joints of the rig; empty: the files have no rig
  /// Row i: the joints that move vertex i, and their weights.
  CompressedRows<Influence> influences = {};

  /// Number of bytes of the inverse bind matrices.
  std::size_t matrix_bytes() const { return joints.size() * 16 * sizeof(float); }
};

/// A vertex attribute of a skinned mesh.
struct GlbSkinAttribute {
  std::string name;    ///< name of the attribute: JOINTS_n or WEIGHTS_n
  int component_type;  ///< component type of the values as a glTF code, such as gltf::kFloat
  std::string bytes;   ///< the attribute's values for all vertices, encoded as in the file
};
/// Builds pairs of the attributes JOINTS_n and WEIGHTS_n. A pair holds four influences per vertex.
/// The vertex with the most influences determines the number of pairs.
/// \param vertices  for each vertex of the file, its row in `influences`
std::vector<GlbSkinAttribute> skin_attributes(const CompressedRows<Influence>& influences,
                                              std::span<const std::uint32_t> vertices);

/// Adds the skin and the joints' nodes; joints without a parent become children of the first node.
/// `set_joint_positions` later sets the positions of the joints.
/// \param matrices  index of the accessor of the inverse bind matrices
void add_joints(const GlbSkin& skin, std::size_t matrices, nlohmann::ordered_json& scene);
/// Sets the positions of the joints.
/// \param first  index of the first joint's node
/// \param joint_positions  #joints by 3
void set_joint_positions(const GlbSkin& skin, std::size_t first, const Positions& joint_positions,
                         nlohmann::ordered_json& scene);
/// Writes the inverse bind matrices.
/// \return the end of the output.
char* put_bind_matrices(char* out, const GlbSkin& skin, const Positions& joint_positions);

}  // namespace crowdface
