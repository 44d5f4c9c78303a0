// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/gltf_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/foreign_file.h"
#include "crowdface/io/gltf_file.h"

namespace crowdface {
namespace {

using Json = GltfFile::Json;

constexpr std::size_t kLongestJointName = 1000;  ///< maximum length of a joint's name in bytes

class RigReader {
 public:
  RigReader(std::string_view bytes, const std::filesystem::path& path)
      : file_(bytes, path),
        parents_(file_.parents()),
        world_transforms_(file_.world_transforms(parents_)) {
    const Json& nodes = file_.scene().at("nodes");
    joint_of_.assign(nodes.size(), kNoIndex);
    for (const Json& skin : file_.scene().value("skins", Json::array())) {
      for (const Json& joint : skin.at("joints")) joint_of_.at(joint.get<std::size_t>()) = 0;
    }
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      if (joint_of_[n] == kNoIndex) continue;
      joint_of_[n] = static_cast<std::uint32_t>(rig_.joints.size());
      rig_.joints.push_back({joint_name(nodes[n], n), 0, world_transforms_[n]});
    }
    if (rig_.joints.empty()) file_.fail("expected a mesh that is bound to joints, found no skin");
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      if (joint_of_[n] != kNoIndex) rig_.joints[joint_of_[n]].parent = joint_above(parents_[n]);
    }
  }

  GltfRig read() {
    const Json& nodes = file_.scene().at("nodes");
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      if (!nodes[n].contains("mesh")) continue;
      const Json& mesh = file_.scene().at("meshes").at(nodes[n].at("mesh").get<std::size_t>());
      std::optional<std::size_t> skin;
      if (nodes[n].contains("skin")) skin = nodes[n].at("skin").get<std::size_t>();
      // Primitives may share vertices, so read each accessor of positions only once.
      std::map<std::size_t, bool> read;
      for (const Json& primitive : mesh.at("primitives")) {
        const auto positions = primitive.at("attributes").at("POSITION").get<std::size_t>();
        if (read.emplace(positions, true).second) add(primitive.at("attributes"), n, skin);
      }
    }
    rig_.positions.resize(static_cast<Index>(points_.size()), 3);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      rig_.positions.row(static_cast<Index>(p)) = points_[p].transpose();
    }
    if (rig_.vertex_ids.size() != points_.size()) rig_.vertex_ids.clear();
    return std::move(rig_);
  }

 private:
  std::string joint_name(const Json& node, std::uint32_t number) const {
    std::string name = node.value("name", concat("joint_", number));
    if (name.size() > kLongestJointName) {
      file_.fail(
          concat("expected names of at most ", kLongestJointName, " bytes, found ", name.size()));
    }
    return name;
  }

  std::uint32_t joint_above(std::uint32_t node) const {
    while (node != kNoIndex && joint_of_[node] == kNoIndex) node = parents_[node];
    return node == kNoIndex ? kNoIndex : joint_of_[node];
  }

  void add(const Json& attributes, std::uint32_t node, std::optional<std::size_t> skin) {
    const std::vector<double> places =
        file_.read_values(attributes.at("POSITION").get<std::size_t>(), 3);
    const std::size_t count = places.size() / 3;
    if (attributes.contains("_VERTEX_ID")) {
      const auto ids =
          file_.read_unsigned_values(attributes.at("_VERTEX_ID").get<std::size_t>(), 1);
      if (ids.size() != count) file_.fail("_VERTEX_ID and POSITION differ in length");
      rig_.vertex_ids.insert(rig_.vertex_ids.end(), ids.begin(), ids.end());
    }
    if (skin) return add_skinned(attributes, places, skin_of(*skin));
    const std::uint32_t joint = joint_above(node);
    if (joint == kNoIndex) {
      file_.fail(
          concat("the mesh of its node ", node, " is neither bound to a joint nor below one"));
    }
    const Eigen::Matrix4d& place = world_transforms_[node];
    for (std::size_t p = 0; p < count; ++p) {
      points_.push_back(transform_point(place, &places[3 * p]));
      rig_.influences.add_group(std::array{Influence{joint, 1}});
    }
  }

  /// The joints of a skin, in the order of the indices in JOINTS_n.
  struct Skin {
    std::vector<std::uint32_t> joints;
    /// for each joint, the transform from the mesh's axes to the file's axes in the rest pose
    std::vector<Eigen::Matrix4d> rest_transforms;
  };
  const Skin& skin_of(std::size_t number) {
    const auto [known, is_new] = skins_.try_emplace(number);
    Skin& skin = known->second;
    if (!is_new) return skin;
    const Json& json = file_.scene().at("skins").at(number);
    for (const Json& joint : json.at("joints")) {
      skin.joints.push_back(joint_of_[joint.get<std::size_t>()]);
    }
    skin.rest_transforms = file_.joint_transforms(number, world_transforms_);
    return skin;
  }

  void add_skinned(const Json& attributes, const std::vector<double>& places, const Skin& skin) {
    const std::size_t count = places.size() / 3;
    const GltfSkinWeights by = file_.read_skin_weights(attributes, count);
    for (std::size_t p = 0; p < count; ++p) {
      std::map<std::uint32_t, double> of_point;
      double sum = 0;
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < 4 * by.joints.size(); ++i) {
        const double weight = by.weights[i / 4][4 * p + i % 4];
        if (!(weight > 0)) continue;
        const std::size_t joint = by.joints[i / 4][4 * p + i % 4];
        if (joint >= skin.joints.size()) {
          file_.fail(
              concat("a vertex is bound to the joint ", joint, ", which its skin does not have"));
        }
        of_point[skin.joints[joint]] += weight;
        place += weight * transform_point(skin.rest_transforms[joint], &places[3 * p]);
        sum += weight;
      }
      if (!(sum > 0)) file_.fail(concat("its vertex ", p, " is bound to no joint"));
      points_.emplace_back(place / sum);
      std::vector<Influence> influences;
      for (const auto& [joint, weight] : of_point) {
        influences.push_back({joint, static_cast<float>(weight / sum)});
      }
      rig_.influences.add_group(influences);
    }
  }

  GltfFile file_;
  std::vector<std::uint32_t> parents_;  ///< parent of each node, or kNoIndex
  /// for each node, the transform from its axes to the file's axes in the rest pose
  std::vector<Eigen::Matrix4d> world_transforms_;
  /// for each node, the index of its joint in `rig_.joints`; kNoIndex if the node is not a joint
  std::vector<std::uint32_t> joint_of_;
  std::map<std::size_t, Skin> skins_;
  std::vector<Eigen::Vector3d> points_;
  GltfRig rig_;
};

}  // namespace

GltfRig read_gltf_rig(const std::filesystem::path& path) {
  try {
    const MappedFile file(path);
    refuse_non_mesh_file(file.bytes(), path);
    return RigReader(file.bytes(), path).read();
  } catch (const Json::exception& error) {
    refuse_file(path, concat("expected a valid glTF 2.0 scene: ", error.what()));
  } catch (const std::out_of_range&) {
    refuse_file(path, "it refers to nodes, joints or accessors that it does not have");
  }
}

}  // namespace crowdface
