// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/glb_scene.h"

#include <numeric>
#include <string_view>
#include <utility>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "crowdface/core/parallel.h"
#include "crowdface/core/rounded.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {

using Json = nlohmann::ordered_json;
using namespace gltf;

namespace {

/// The unit quaternion (x, y, z, w) that rotates `up` to +Y and `front` to +Z.
std::array<double, 4> rotation_to_gltf(Axis up, Axis front) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  turn(1, up.index) = up.sign;
  turn(2, front.index) = front.sign;
  turn.row(0) = turn.row(1).cross(turn.row(2));
  const Eigen::Quaterniond q(turn);
  return {q.x() + 0.0, q.y() + 0.0, q.z() + 0.0, q.w() + 0.0};  // avoids negative zero
}

}  // namespace

Json vector_json(const Eigen::RowVector3d& vector) {
  Json json = Json::array();
  for (const double part : vector) json.push_back(static_cast<double>(to_single(part)));
  return json;
}

void set_bounds(Json& accessor, const Positions& positions) {
  accessor["min"] = vector_json(positions.colwise().minCoeff());
  accessor["max"] = vector_json(positions.colwise().maxCoeff());
}

Json material_json(const GlbMaterial& material, std::size_t overlay_texture) {
  Json json = Json::object();
  if (!material.name.empty()) json["name"] = material.name;
  Json colour = Json::array();
  for (const float part : material.colour) {
    colour.push_back(material.uses_overlay ? 1.0 : rounded(part) + 0.0);
  }
  json["pbrMetallicRoughness"] = {
      {"baseColorFactor", colour}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.6}};
  if (material.image) {
    json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", *material.image}};
  } else if (material.uses_overlay) {
    json["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", overlay_texture},
                                                        {"texCoord", 1}};
  }
  if (material.roughness_image) {
    json["pbrMetallicRoughness"]["roughnessFactor"] = 1.0;
    json["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {
        {"index", *material.roughness_image}};
  }
  if (material.normal_image) json["normalTexture"] = {{"index", *material.normal_image}};
  if (!material.alpha && material.colour[3] < 1) json["alphaMode"] = "BLEND";
  json["doubleSided"] = true;  // heads are open at the neck
  if (material.alpha == GlbMaterial::Alpha::kMask) json["alphaMode"] = "MASK";
  if (material.alpha == GlbMaterial::Alpha::kBlend) json["alphaMode"] = "BLEND";
  return json;
}

Json root_node_json(const GlbOptions& options) {
  Json node = {{"name", ""}};
  if (options.skin.joints.empty()) node = {{"mesh", 0}, {"name", ""}};
  const auto rotation = rotation_to_gltf(options.up, options.front);
  if (rotation[3] != 1) node["rotation"] = rotation;
  constexpr double kMmPerMetre = 1000;
  const double scale = mm_per(options.unit) / kMmPerMetre;
  if (scale != 1) node["scale"] = {scale, scale, scale};
  return node;
}

void add_image(Json& scene, std::size_t view, const std::string& name, const std::string& type) {
  scene["textures"].push_back(Json::object({{"source", scene["images"].size()}}));
  scene["images"].push_back({{"name", name}, {"bufferView", view}, {"mimeType", type}});
}

std::vector<GlbTriangles> triangles_by_material(const SplitVertices& split,
                                                const std::vector<std::uint32_t>& polygon_materials,
                                                std::size_t material_count) {
  std::vector<GlbTriangles> groups(material_count);
  for (std::size_t t = 0; t < split.triangles.size(); ++t) {
    const std::size_t material =
        polygon_materials.empty() ? 0 : polygon_materials[split.triangle_faces[t]];
    groups.at(material).push_back(split.triangles[t]);
  }
  return groups;
}

void put_vectors(char* out, const Positions& rows, std::span<const std::uint32_t> copied_vertices) {
  const auto copies = static_cast<Index>(copied_vertices.size());
  parallel_blocks(rows.rows() + copies, kRowsPerBlock, [&](Index begin, Index end) {
    char* at = out + static_cast<std::size_t>(begin) * kVectorSize;
    for (Index i = begin; i < end; ++i) {
      const Index row =
          i < rows.rows()
              ? i
              : static_cast<Index>(copied_vertices[static_cast<std::size_t>(i - rows.rows())]);
      at = put_row(at, rows, row);
    }
  });
}

void set_morph_targets(Json& mesh, std::size_t first, const std::vector<std::string>& names) {
  if (names.empty()) return;
  Json targets = Json::array();
  for (std::size_t t = 0; t < names.size(); ++t) targets.push_back({{"POSITION", first + t}});
  for (Json& primitive : mesh["primitives"]) primitive["targets"] = targets;
  mesh["weights"] = std::vector<double>(names.size(), 0.0);
  mesh["extras"] = {{"targetNames", names}};
}

std::size_t GlbBuffer::add_view(std::size_t size, int target) {
  Json view = {{"buffer", 0}, {"byteOffset", size_}, {"byteLength", size}};
  if (target != 0) view["target"] = target;
  scene_["bufferViews"].push_back(std::move(view));
  size_ += size;
  return scene_["bufferViews"].size() - 1;
}

std::size_t GlbBuffer::pad() {
  const std::size_t missing = (4 - size_ % 4) % 4;
  size_ += missing;
  return missing;
}

std::size_t GlbBuffer::add_accessor(int component, const char* type, std::size_t count,
                                    std::size_t offset) {
  Json accessor = {{"bufferView", scene_["bufferViews"].size() - 1}};
  if (offset > 0) accessor["byteOffset"] = offset;
  accessor["componentType"] = component;
  accessor["count"] = count;
  accessor["type"] = type;
  scene_["accessors"].push_back(std::move(accessor));
  return scene_["accessors"].size() - 1;
}

std::size_t GlbBuffer::add_attribute(int component, const char* type, std::size_t count) {
  const std::string_view name = type;
  const std::size_t numbers = name == "SCALAR" ? 1 : static_cast<std::size_t>(name.back() - '0');
  const std::size_t size = component == kFloat ? sizeof(float) : sizeof(std::uint16_t);
  add_view(count * numbers * size, kArrayBuffer);
  return add_accessor(component, type, count);
}

Json GlbBuffer::add_primitives(std::span<const std::size_t> index_counts, const Json& attributes,
                               std::span<const GlbMaterial> materials,
                               std::optional<std::size_t> overlay, std::size_t overlay_texture) {
  add_view(std::accumulate(index_counts.begin(), index_counts.end(), std::size_t{0}) *
               sizeof(std::uint32_t),
           kElementArrayBuffer);
  Json primitives = Json::array();
  std::size_t offset = 0;
  for (std::size_t g = 0; g < index_counts.size(); ++g) {
    if (index_counts[g] == 0) continue;
    Json primitive = {{"attributes", attributes},
                      {"indices", add_accessor(kUnsignedInt, "SCALAR", index_counts[g], offset)}};
    if (!materials.empty()) {
      primitive["material"] = scene_["materials"].size();
      scene_["materials"].push_back(material_json(materials[g], overlay_texture));
      if (overlay && materials[g].uses_overlay) primitive["attributes"]["TEXCOORD_1"] = *overlay;
    }
    primitives.push_back(std::move(primitive));
    offset += index_counts[g] * sizeof(std::uint32_t);
  }
  return primitives;
}

void GlbBuffer::add_zeros(std::size_t count) {
  scene_["accessors"].push_back({{"componentType", kFloat}, {"count", count}, {"type", "VEC3"}});
}

void GlbBuffer::make_sparse(std::size_t count, std::size_t indices, std::size_t values) {
  scene_["accessors"].back()["sparse"] = {
      {"count", count},
      {"indices", {{"bufferView", indices}, {"componentType", kUnsignedInt}}},
      {"values", {{"bufferView", values}}}};
}

void GlbBuffer::finish() {
  scene_["buffers"][0]["byteLength"] = size_;
}

std::string encoded_texture_coordinates(const SplitVertices& split, const TextureCoordinates& uvs) {
  std::string bytes;
  bytes.reserve(split.uvs.size() * 2 * sizeof(float));
  for (const std::uint32_t uv : split.uvs) {
    const bool has_one = uv != kNoIndex;
    append_number(bytes, has_one ? to_single(uvs(uv, 0)) : 0.0F);
    append_number(bytes, has_one ? to_single(1 - uvs(uv, 1)) : 0.0F);  // glTF's v points down
  }
  return bytes;
}

GlbMorphRows morph_target_rows(std::span<const std::uint32_t> vertices,
                               std::span<const std::uint32_t> split, Index count) {
  std::vector<std::uint32_t> row_of(static_cast<std::size_t>(count), kNoIndex);
  for (std::uint32_t row = 0; row < vertices.size(); ++row) row_of[vertices[row]] = row;
  GlbMorphRows rows;
  rows.moves_all_vertices = vertices.size() == row_of.size();
  for (std::uint32_t i = 0; i < split.size(); ++i) {
    if (row_of[split[i]] == kNoIndex) continue;
    rows.rows.push_back(row_of[split[i]]);
    rows.vertices.push_back(i);
  }
  return rows;
}

void set_displacement_bounds(Json& accessor, const Displacements& moves, bool moves_all_vertices) {
  Eigen::RowVector3d least = Eigen::RowVector3d::Zero(), most = least;
  if (moves.moves.rows() > 0) {
    least = moves.moves.colwise().minCoeff();
    most = moves.moves.colwise().maxCoeff();
    if (!moves_all_vertices) {
      least = least.cwiseMin(0);
      most = most.cwiseMax(0);
    }
  }
  accessor["min"] = vector_json(least);
  accessor["max"] = vector_json(most);
}

}  // namespace crowdface
