// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/gltf_rig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/glb_container.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/shallow_json.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;
using namespace gltf;

constexpr std::size_t kLongestJointName = 1000;  ///< of a joint, bytes
constexpr double kFarthest = 1e6;                ///< of what a matrix holds: a thousand kilometres

/// A glTF scene and its buffer, with messages that name the file.
class GltfFile {
 public:
  explicit GltfFile(const std::filesystem::path& path) : path_(path), file_(path) {
    const auto chunks = glb_chunks(file_.bytes());
    if (!chunks) fail("expected a binary glTF 2.0 file (GLB), found another");
    scene_ = parse_shallow_json(chunks->json);
    binary_ = chunks->binary;
    if (!scene_.is_object()) fail("its JSON cannot be read");
  }

  const Json& scene() const { return scene_; }
  [[noreturn]] void fail(const std::string& what) const { refuse_file(path_, what); }

  /// The numbers of an accessor, row after row; those that are normalized as what they stand for.
  std::vector<double> numbers(std::size_t accessor, std::size_t width) {
    const Json& json = scene_.at("accessors").at(accessor);
    if (json.contains("sparse") || !json.contains("bufferView")) {
      fail(concat("accessor ", accessor, " is sparse, which is not read here"));
    }
    const Json& view = scene_.at("bufferViews").at(json.at("bufferView").get<std::size_t>());
    const auto type = json.at("componentType").get<int>();
    const std::size_t size = type == kUnsignedByte || type == kByte     ? 1
                             : type == kUnsignedShort || type == kShort ? 2
                                                                        : 4;
    const std::size_t count = json.at("count").get<std::size_t>();
    const std::size_t stride = view.value("byteStride", size * width);
    const std::size_t begin =
        view.value("byteOffset", std::size_t{0}) + json.value("byteOffset", std::size_t{0});
    if (view.value("buffer", 0) != 0 || count == 0 || begin > binary_.size() ||
        stride > binary_.size() || stride < size * width || count > binary_.size() / stride + 1 ||
        begin + (count - 1) * stride + size * width > binary_.size()) {
      fail(concat("accessor ", accessor, " lies outside the file's own buffer"));
    }
    require_room(count * width);
    const double unit = !json.value("normalized", false) ? 1 : size == 1 ? 1.0 / 255 : 1.0 / 65535;
    std::vector<double> numbers;
    numbers.reserve(count * width);
    for (std::size_t row = 0; row < count; ++row) {
      const char* at = binary_.data() + begin + row * stride;
      for (std::size_t c = 0; c < width; ++c, at += size) {
        numbers.push_back(unit * number(at, type, accessor));
      }
    }
    if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); })) {
      fail(concat("accessor ", accessor, " has numbers that are not finite"));
    }
    return numbers;
  }
  /// The same where they count something.
  std::vector<std::uint32_t> whole_numbers(std::size_t accessor, std::size_t width) {
    std::vector<std::uint32_t> whole;
    for (const double number : numbers(accessor, width)) {
      if (number < 0 || number >= kNoIndex) {
        fail(concat("accessor ", accessor, ": expected whole numbers, found ", number));
      }
      whole.push_back(static_cast<std::uint32_t>(number));
    }
    return whole;
  }

 private:
  /// A mesh may stand at many nodes, and many names may stand for the same numbers.
  void require_room(std::size_t more) {
    constexpr std::size_t kOften = 4;
    if (more > kOften * binary_.size() - read_) {
      fail("its meshes and skins have more numbers than its buffer has bytes, several times over");
    }
    read_ += more;
  }
  double number(const char* at, int type, std::size_t accessor) const {
    if (type == kUnsignedByte) return number_at<std::uint8_t>(at);
    if (type == kUnsignedShort) return number_at<std::uint16_t>(at);
    if (type == kUnsignedInt) return number_at<std::uint32_t>(at);
    if (type == kFloat) return static_cast<double>(number_at<float>(at));
    fail(concat("accessor ", accessor, " has numbers of the unexpected type ", type));
  }

  std::filesystem::path path_;
  MappedFile file_;
  Json scene_;
  std::string_view binary_;
  std::size_t read_ = 0;  ///< numbers
};

Eigen::Matrix4d matrix_from(const std::vector<double>& columns) {
  Eigen::Matrix4d matrix;
  for (Index c = 0; c < 4; ++c) {
    for (Index r = 0; r < 4; ++r) matrix(r, c) = columns.at(static_cast<std::size_t>(4 * c + r));
  }
  return matrix;
}

/// Written out: a library's product chooses its order by the machine.
Eigen::Matrix4d times(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) {
  Eigen::Matrix4d product;
  for (Index r = 0; r < 4; ++r) {
    for (Index c = 0; c < 4; ++c) {
      product(r, c) = a(r, 0) * b(0, c) + a(r, 1) * b(1, c) + a(r, 2) * b(2, c) + a(r, 3) * b(3, c);
    }
  }
  return product;
}

Eigen::Matrix4d local_matrix(const Json& node) {
  if (node.contains("matrix")) return matrix_from(node.at("matrix").get<std::vector<double>>());
  const auto t = node.value("translation", std::vector<double>{0, 0, 0});
  const auto q = node.value("rotation", std::vector<double>{0, 0, 0, 1});
  const auto s = node.value("scale", std::vector<double>{1, 1, 1});
  const double x = q.at(0), y = q.at(1), z = q.at(2), w = q.at(3);
  Eigen::Matrix4d matrix;
  matrix << s.at(0) * (1 - 2 * (y * y + z * z)), s.at(1) * 2 * (x * y - z * w),
      s.at(2) * 2 * (x * z + y * w), t.at(0),  //
      s.at(0) * 2 * (x * y + z * w), s.at(1) * (1 - 2 * (x * x + z * z)),
      s.at(2) * 2 * (y * z - x * w), t.at(1),  //
      s.at(0) * 2 * (x * z - y * w), s.at(1) * 2 * (y * z + x * w),
      s.at(2) * (1 - 2 * (x * x + y * y)), t.at(2),  //
      0, 0, 0, 1;
  return matrix;
}

class RigReader {
 public:
  explicit RigReader(const std::filesystem::path& path) : file_(path) {
    const Json& nodes = file_.scene().at("nodes");
    parents_.assign(nodes.size(), kNoIndex);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      for (const Json& child : nodes[n].value("children", Json::array())) {
        parents_.at(child.get<std::size_t>()) = n;
      }
    }
    find_worlds();
    joint_of_.assign(nodes.size(), kNoIndex);
    for (const Json& skin : file_.scene().value("skins", Json::array())) {
      for (const Json& joint : skin.at("joints")) joint_of_.at(joint.get<std::size_t>()) = 0;
    }
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      if (joint_of_[n] == kNoIndex) continue;
      joint_of_[n] = static_cast<std::uint32_t>(rig_.joints.size());
      rig_.joints.push_back({joint_name(nodes[n], n), 0, worlds_[n]});
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
      // Primitives may share their vertices.
      std::map<std::size_t, bool> read;
      for (const Json& primitive : mesh.at("primitives")) {
        const auto positions = primitive.at("attributes").at("POSITION").get<std::size_t>();
        if (read.emplace(positions, true).second) add(primitive.at("attributes"), n, skin);
      }
    }
    rig_.points.resize(static_cast<Index>(points_.size()), 3);
    for (std::size_t p = 0; p < points_.size(); ++p) {
      rig_.points.row(static_cast<Index>(p)) = points_[p].transpose();
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

  /// From the roots down, each node once.
  void find_worlds() {
    const Json& nodes = file_.scene().at("nodes");
    worlds_.resize(parents_.size());
    std::vector<bool> known(parents_.size(), false);
    std::vector<std::uint32_t> above;
    for (std::uint32_t node = 0; node < parents_.size(); ++node) {
      for (std::uint32_t n = node; n != kNoIndex && !known[n]; n = parents_[n]) {
        if (above.size() == parents_.size()) file_.fail("its nodes hang on each other in a circle");
        above.push_back(n);
      }
      for (; !above.empty(); above.pop_back()) {
        const std::uint32_t n = above.back(), parent = parents_[n];
        const Eigen::Matrix4d local = local_matrix(nodes[n]);
        worlds_[n] = parent == kNoIndex ? local : times(worlds_[parent], local);
        if (!(worlds_[n].array().abs() < kFarthest).all()) {
          file_.fail(concat("expected its node ", n, " at a place, found it beyond all measure"));
        }
        known[n] = true;
      }
    }
  }
  std::uint32_t joint_above(std::uint32_t node) const {
    while (node != kNoIndex && joint_of_[node] == kNoIndex) node = parents_[node];
    return node == kNoIndex ? kNoIndex : joint_of_[node];
  }

  void add(const Json& attributes, std::uint32_t node, std::optional<std::size_t> skin) {
    const std::vector<double> places =
        file_.numbers(attributes.at("POSITION").get<std::size_t>(), 3);
    const std::size_t count = places.size() / 3;
    if (attributes.contains("_VERTEX_ID")) {
      const auto ids = file_.whole_numbers(attributes.at("_VERTEX_ID").get<std::size_t>(), 1);
      if (ids.size() != count) file_.fail("_VERTEX_ID and POSITION differ in length");
      rig_.vertex_ids.insert(rig_.vertex_ids.end(), ids.begin(), ids.end());
    }
    if (skin) return add_skinned(attributes, places, skin_of(*skin));
    const std::uint32_t joint = joint_above(node);
    if (joint == kNoIndex) {
      file_.fail(concat("the mesh of its node ", node, " is bound to no joint and hangs on none"));
    }
    const Eigen::Matrix4d& place = worlds_[node];
    for (std::size_t p = 0; p < count; ++p) {
      points_.push_back(moved(place, &places[3 * p]));
      rig_.influences.add_group(std::array{Influence{joint, 1}});
    }
  }

  static Eigen::Vector3d moved(const Eigen::Matrix4d& by, const double* p) {
    Eigen::Vector3d to;
    for (Index r = 0; r < 3; ++r) {
      to[r] = by(r, 0) * p[0] + by(r, 1) * p[1] + by(r, 2) * p[2] + by(r, 3);
    }
    return to;
  }

  /// What the numbers in JOINTS_n mean.
  struct Skin {
    std::vector<std::uint32_t> joints;
    std::vector<Eigen::Matrix4d> at_rest;  ///< #joints, from a mesh's own axes
  };
  const Skin& skin_of(std::size_t number) {
    const auto [known, is_new] = skins_.try_emplace(number);
    Skin& skin = known->second;
    if (!is_new) return skin;
    const Json& json = file_.scene().at("skins").at(number);
    for (const Json& joint : json.at("joints")) {
      skin.joints.push_back(joint_of_[joint.get<std::size_t>()]);
    }
    std::vector<double> inverses;
    if (json.contains("inverseBindMatrices")) {
      inverses = file_.numbers(json.at("inverseBindMatrices").get<std::size_t>(), 16);
      if (inverses.size() < 16 * skin.joints.size())
        file_.fail("a skin lacks inverse bind matrices");
    }
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      skin.at_rest.push_back(rig_.joints[skin.joints[j]].rest);
      if (inverses.empty()) continue;
      const auto first = inverses.begin() + static_cast<std::ptrdiff_t>(16 * j);
      skin.at_rest.back() = times(skin.at_rest.back(), matrix_from({first, first + 16}));
    }
    return skin;
  }

  void add_skinned(const Json& attributes, const std::vector<double>& places, const Skin& skin) {
    const std::size_t count = places.size() / 3;
    std::vector<std::vector<std::uint32_t>> bound;
    std::vector<std::vector<double>> weights;
    for (std::size_t set = 0; attributes.contains(concat("JOINTS_", set)); ++set) {
      const std::string of_weights = concat("WEIGHTS_", set);
      if (!attributes.contains(of_weights)) file_.fail(concat("a mesh lacks ", of_weights));
      bound.push_back(
          file_.whole_numbers(attributes.at(concat("JOINTS_", set)).get<std::size_t>(), 4));
      weights.push_back(file_.numbers(attributes.at(of_weights).get<std::size_t>(), 4));
      if (bound.back().size() != 4 * count || weights.back().size() != 4 * count) {
        file_.fail("JOINTS_n, WEIGHTS_n and POSITION differ in length");
      }
    }
    for (std::size_t p = 0; p < count; ++p) {
      std::map<std::uint32_t, double> of_point;
      double sum = 0;
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      for (std::size_t i = 0; i < 4 * bound.size(); ++i) {
        const double weight = weights[i / 4][4 * p + i % 4];
        if (!(weight > 0)) continue;
        const std::size_t joint = bound[i / 4][4 * p + i % 4];
        if (joint >= skin.joints.size()) {
          file_.fail(concat("a vertex is bound to the joint ", joint));
        }
        of_point[skin.joints[joint]] += weight;
        place += weight * moved(skin.at_rest[joint], &places[3 * p]);
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
  std::vector<std::uint32_t> parents_, joint_of_;  ///< #nodes
  std::vector<Eigen::Matrix4d> worlds_;            ///< #nodes, each at rest
  std::map<std::size_t, Skin> skins_;
  std::vector<Eigen::Vector3d> points_;
  GltfRig rig_;
};

}  // namespace

GltfRig read_gltf_rig(const std::filesystem::path& path) {
  try {
    return RigReader(path).read();
  } catch (const Json::exception& error) {
    refuse_file(path, concat("not a scene that glTF 2.0 allows: ", error.what()));
  } catch (const std::out_of_range&) {
    refuse_file(path, "it speaks of nodes, joints or numbers that it does not have");
  }
}

}  // namespace crowdface
