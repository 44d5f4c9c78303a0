// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// How much a joint moves a vertex.
struct Influence {
  std::uint32_t joint;
  float weight;  ///< those of a vertex add up to one
};

/// A joint of a rig that every file has; where it stands is each face's own.
struct GlbJoint {
  std::string name;
  std::uint32_t parent;      ///< kNoIndex: it has none
  Eigen::Matrix3d rotation;  ///< of its axes, in the positions' axes
};

/// Joints below a face's node, and which of them move its vertices.
struct GlbSkin {
  std::vector<GlbJoint> joints;        ///< none: there is no rig
  Grouped<Influence> influences = {};  ///< #V

  std::size_t matrix_bytes() const { return joints.size() * 16 * sizeof(float); }
};

/// JOINTS_n or WEIGHTS_n of each vertex of a file: its type as an accessor, and its bytes.
struct GlbSkinAttribute {
  std::string name;
  int component;
  std::string bytes;
};
/// As many sets of four as the vertex that has most needs.
/// \param vertices  of the file: which of the influences' groups each has
std::vector<GlbSkinAttribute> skin_attributes(const Grouped<Influence>& influences,
                                              std::span<const std::uint32_t> vertices);

/// Adds the joints' nodes, below the first node, and the skin; where they stand is left to `place_joints`.
void add_joints(const GlbSkin& skin, std::size_t matrices, nlohmann::ordered_json& scene);
/// \param first   the node of the first joint
/// \param places  #joints by 3
void place_joints(const GlbSkin& skin, std::size_t first, const Positions& places,
                  nlohmann::ordered_json& scene);
/// Writes the inverse bind matrices. \return where they end.
char* put_bind_matrices(char* out, const GlbSkin& skin, const Positions& places);

}  // namespace crowdface
