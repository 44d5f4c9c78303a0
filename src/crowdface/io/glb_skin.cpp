// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/glb_skin.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "crowdface/core/text.h"
#include "crowdface/io/glb_container.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kOfSet = 4;

/// Applies the inverse of a rotation to a vector.
Eigen::Vector3d inversely_rotated(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& v) {
  Eigen::Vector3d back;
  for (Index c = 0; c < 3; ++c) {
    back[c] = rotation(0, c) * v.x() + rotation(1, c) * v.y() + rotation(2, c) * v.z();
  }
  return back;
}

Json rotation_json(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  Json json = Json::array();
  for (const double part : {q.x(), q.y(), q.z(), q.w()}) {
    json.push_back(static_cast<double>(to_single(part)) + 0.0);
  }
  return json;
}

}  // namespace

std::vector<GlbSkinAttribute> skin_attributes(const CompressedRows<Influence>& influences,
                                              std::span<const std::uint32_t> vertices) {
  std::size_t most = 1;
  for (const std::uint32_t v : vertices) most = std::max(most, influences.items_of(v).size());
  std::vector<GlbSkinAttribute> attributes;
  for (std::size_t set = 0; set * kOfSet < most; ++set) {
    GlbSkinAttribute joints{concat("JOINTS_", set), gltf::kUnsignedShort, {}};
    GlbSkinAttribute weights{concat("WEIGHTS_", set), gltf::kFloat, {}};
    for (const std::uint32_t v : vertices) {
      const auto of = influences.items_of(v);
      for (std::size_t i = kOfSet * set; i < kOfSet * (set + 1); ++i) {
        const Influence one = i < of.size() ? of[i] : Influence{0, 0};
        append_number(joints.bytes, static_cast<std::uint16_t>(one.joint));
        append_number(weights.bytes, one.weight);
      }
    }
    attributes.push_back(std::move(joints));
    attributes.push_back(std::move(weights));
  }
  return attributes;
}

void add_joints(const GlbSkin& skin, std::size_t matrices, Json& scene) {
  const std::size_t first = scene["nodes"].size();
  Json joints = Json::array();
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    const GlbJoint& joint = skin.joints[j];
    Eigen::Matrix3d local = joint.rotation;
    if (joint.parent != kNoIndex) {
      local = skin.joints[joint.parent].rotation.transpose() * joint.rotation;
    }
    scene["nodes"].push_back({{"name", joint.name},
                              {"translation", {0.0, 0.0, 0.0}},
                              {"rotation", rotation_json(local)}});
    joints.push_back(first + j);
  }
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    const std::uint32_t parent = skin.joints[j].parent;
    const std::size_t above = parent == kNoIndex ? 0 : first + parent;
    scene["nodes"][above]["children"].push_back(first + j);
  }
  scene["skins"] =
      Json::array({Json{{"joints", std::move(joints)}, {"inverseBindMatrices", matrices}}});
}

void set_joint_positions(const GlbSkin& skin, std::size_t first, const Positions& joint_positions,
                         Json& scene) {
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    Eigen::Vector3d at = joint_positions.row(static_cast<Index>(j)).transpose();
    const std::uint32_t parent = skin.joints[j].parent;
    if (parent != kNoIndex) {
      at = inversely_rotated(skin.joints[parent].rotation,
                             at - joint_positions.row(parent).transpose());
    }
    Json& translation = scene["nodes"][first + j]["translation"];
    for (std::size_t c = 0; c < 3; ++c) {
      translation[c] = static_cast<double>(to_single(at[static_cast<Index>(c)]));
    }
  }
}

char* put_bind_matrices(char* out, const GlbSkin& skin, const Positions& joint_positions) {
  for (std::size_t j = 0; j < skin.joints.size(); ++j) {
    const Eigen::Matrix3d& rotation = skin.joints[j].rotation;
    const Eigen::Vector3d shift =
        inversely_rotated(rotation, -joint_positions.row(static_cast<Index>(j)).transpose());
    for (Index c = 0; c < 3; ++c) {
      for (Index r = 0; r < 3; ++r) out = put_number(out, to_single(rotation(c, r)));
      out = put_number(out, 0.0F);
    }
    for (Index r = 0; r < 3; ++r) out = put_number(out, to_single(shift[r]));
    out = put_number(out, 1.0F);
  }
  return out;
}

}  // namespace crowdface
