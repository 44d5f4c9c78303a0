// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstring>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/wrap/scan_file.h"

namespace crowdface {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr int kTriangles = 4;
constexpr int kDeepest = 64;  ///< nodes below nodes, values within values

/// Walks through the scene of a GLB file (glTF 2.0, sections 3 and 4) and collects its triangles.
class GlbReader {
 public:
  GlbReader(std::string_view bytes, const std::string& name) : name_(name) {
    if (bytes.size() < 20 || number(bytes, 0) != kMagic || number(bytes, 4) != 2) {
      fail("it does not begin as one of version 2 does");
    }
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
      const std::size_t length = number(bytes, at);
      const std::uint32_t kind = number(bytes, at + 4);
      if (bytes.size() - at - 8 < length) fail("it ends too soon");
      const std::string_view chunk = bytes.substr(at + 8, length);
      if (kind == kJsonChunk) {
        json_ = Json::parse(
            chunk, [](int depth, Json::parse_event_t, Json&) { return depth < kDeepest; }, false);
      } else if (kind == kBinaryChunk) {
        binary_ = chunk;
      }
      at += 8 + length;
    }
    if (!json_.is_object()) fail("it holds no JSON");
  }

  Scan read() {
    try {
      const Json& scenes = json_.at("scenes");
      for (const Json& node : scenes.at(json_.value("scene", std::size_t{0})).at("nodes")) {
        visit(node.get<std::size_t>(), Eigen::Matrix4d::Identity(), 0);
      }
    } catch (const Json::exception& error) {
      fail(concat("its JSON is incomplete: ", error.what()));
    }
    Scan scan;
    scan.positions.resize(static_cast<Index>(points_.size()), 3);
    for (std::size_t v = 0; v < points_.size(); ++v) {
      scan.positions.row(static_cast<Index>(v)) = points_[v].transpose();
    }
    scan.triangles = std::move(triangles_);
    return scan;
  }

 private:
  [[noreturn]] void fail(const std::string& found) const {
    throw InvalidInput(concat(name_, ": expected a GLB file, found that ", found));
  }
  static std::uint32_t number(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  }

  static Eigen::Matrix4d matrix_of(const Json& node) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    if (node.contains("matrix")) {
      for (Index i = 0; i < 16; ++i) {
        matrix(i % 4, i / 4) = node["matrix"].at(static_cast<std::size_t>(i)).get<double>();
      }
      return matrix;
    }
    const auto numbers = [&]<std::size_t N>(const char* key, std::array<double, N> otherwise) {
      return node.contains(key) ? node[key].get<std::array<double, N>>() : otherwise;
    };
    const auto t = numbers("translation", std::array<double, 3>{0, 0, 0}),
               s = numbers("scale", std::array<double, 3>{1, 1, 1});
    const auto r = numbers("rotation", std::array<double, 4>{0, 0, 0, 1});
    matrix.topLeftCorner<3, 3>() =
        Eigen::Quaterniond(r[3], r[0], r[1], r[2]).normalized().toRotationMatrix() *
        Eigen::Vector3d(s[0], s[1], s[2]).asDiagonal();
    matrix.topRightCorner<3, 1>() = Eigen::Vector3d(t[0], t[1], t[2]);
    return matrix;
  }

  void visit(std::size_t index, const Eigen::Matrix4d& above, int depth) {
    if (depth > kDeepest) fail(concat("its nodes stand more than ", kDeepest, " deep"));
    const Json& node = json_.at("nodes").at(index);
    if (!visited_.insert(index).second) fail(concat("node ", index, " stands in two places"));
    const Eigen::Matrix4d matrix = above * matrix_of(node);
    if (node.contains("mesh")) {
      std::map<std::size_t, std::uint32_t> known;
      for (const Json& primitive :
           json_.at("meshes").at(node["mesh"].get<std::size_t>()).at("primitives")) {
        add(primitive, matrix, known);
      }
    }
    if (!node.contains("children")) return;
    for (const Json& child : node["children"]) visit(child.get<std::size_t>(), matrix, depth + 1);
  }

  /// The bytes of an accessor's elements.
  struct Values {
    const char* first = nullptr;
    std::size_t count = 0, stride = 0;
    int type = 0;
  };
  Values values(std::size_t index, std::size_t components) const {
    const Json& accessor = json_.at("accessors").at(index);
    if (accessor.contains("sparse") || !accessor.contains("bufferView")) {
      fail("an accessor is sparse or compressed; export it without compression");
    }
    const Json& view = json_.at("bufferViews").at(accessor["bufferView"].get<std::size_t>());
    if (view.value("buffer", 0) != 0 || json_.at("buffers").at(0).contains("uri")) {
      fail("its data lie in another file");
    }
    Values found;
    found.type = accessor.at("componentType").get<int>();
    found.count = accessor.at("count").get<std::size_t>();
    const std::size_t size = components * (found.type == 5126 || found.type == 5125 ? 4U
                                           : found.type == 5123                     ? 2U
                                                                                    : 1U);
    found.stride = view.value("byteStride", size);
    const std::size_t begin =
        view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0});
    if (found.count == 0 || found.count > binary_.size() || begin > binary_.size() ||
        found.stride > binary_.size() || found.stride < size ||
        (found.count - 1) * found.stride + size > binary_.size() - begin) {
      fail("an accessor reaches beyond its data");
    }
    found.first = binary_.data() + begin;
    return found;
  }

  void add_points(const Values& places, const Eigen::Matrix4d& matrix) {
    if (places.type != 5126) fail("positions are no floats");
    require_room(places.count, points_.size(), "vertices");
    for (std::size_t i = 0; i < places.count; ++i) {
      std::array<float, 3> p{};
      std::memcpy(p.data(), places.first + i * places.stride, sizeof p);
      const Eigen::Vector4d point(p[0], p[1], p[2], 1);
      points_.emplace_back((matrix * point).head<3>());
    }
  }

  /// A mesh may stand at many nodes, and many primitives may name the same data.
  void require_room(std::size_t more, std::size_t so_far, const char* of_what) const {
    if (more <= binary_.size() - so_far) return;
    fail(concat("one mesh stands at so many nodes that they have more ", of_what,
                " than it has bytes"));
  }

  /// \param known  the first point of each accessor that another primitive of the node has named
  void add(const Json& primitive, const Eigen::Matrix4d& matrix,
           std::map<std::size_t, std::uint32_t>& known) {
    if (primitive.value("mode", kTriangles) != kTriangles) return;
    const auto accessor = primitive.at("attributes").at("POSITION").get<std::size_t>();
    const Values places = values(accessor, 3);
    const auto [found, is_new] =
        known.try_emplace(accessor, static_cast<std::uint32_t>(points_.size()));
    if (is_new) add_points(places, matrix);
    const std::uint32_t first = found->second;
    std::vector<std::uint32_t> corners;
    if (primitive.contains("indices")) {
      const Values indices = values(primitive["indices"].get<std::size_t>(), 1);
      require_room(indices.count / 3, triangles_.size(), "triangles");
      for (std::size_t i = 0; i < indices.count; ++i) {
        const char* at = indices.first + i * indices.stride;
        std::uint32_t corner = 0;
        std::memcpy(&corner, at, indices.type == 5125 ? 4 : indices.type == 5123 ? 2 : 1);
        if (corner >= places.count) fail(concat("a triangle names vertex ", corner));
        corners.push_back(first + corner);
      }
    } else {
      require_room(places.count / 3, triangles_.size(), "triangles");
      for (std::uint32_t i = 0; i < places.count; ++i) corners.push_back(first + i);
    }
    const bool mirrored = matrix.topLeftCorner<3, 3>().determinant() < 0;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      triangles_.push_back(
          {corners[i], corners[i + (mirrored ? 2 : 1)], corners[i + (mirrored ? 1 : 2)]});
    }
  }

  const std::string& name_;
  Json json_;
  std::string_view binary_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Triangle> triangles_;
  std::set<std::size_t> visited_;  ///< nodes
};

}  // namespace

Scan parse_glb(std::string_view bytes, const std::string& name) {
  return GlbReader(bytes, name).read();
}

}  // namespace crowdface
