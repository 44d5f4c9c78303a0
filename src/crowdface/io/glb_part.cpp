// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/glb_part.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "crowdface/core/require.h"
#include "crowdface/io/glb_scene.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/io/split_vertices.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;
using namespace gltf;

/// Adds the accessors and buffer views of the morph targets.
/// \param moves  for each morph target, displacements of the part's vertices.
/// \param split  for each split vertex, its original vertex.
void add_targets(std::span<const Displacements> moves, std::span<const std::uint32_t> split,
                 Index vertex_count, Json& scene, GlbBuffer& buffer) {
  for (const Displacements& target : moves) {
    const GlbMorphRows moved = morph_target_rows(target.vertices, split, vertex_count);
    buffer.add_zeros(split.size());
    set_displacement_bounds(scene["accessors"].back(), target, moved.moves_all_vertices);
    const std::size_t rows = moved.rows.size();
    if (rows == 0) continue;
    const std::size_t indices = buffer.add_view(rows * sizeof(std::uint32_t));
    buffer.make_sparse(rows, indices, buffer.add_view(rows * kVectorSize));
  }
}

}  // namespace

GlbPart::GlbPart(std::string name, const Topology& topology, const TextureCoordinates& uvs,
                 const std::vector<GlbMaterial>& materials,
                 const std::vector<std::uint32_t>& polygon_materials,
                 const std::vector<GlbImage>& images, const CompressedRows<Influence>& influences,
                 std::vector<std::string> targets, GivenNormals fixed)
    : name_(std::move(name)),
      topology_(topology),
      fans_(topology),
      materials_(materials),
      targets_(std::move(targets)),
      given_normals_(std::move(fixed)) {
  require(
      !materials.empty() && static_cast<Index>(polygon_materials.size()) == topology.face_count(),
      "GlbPart: a material of each face");
  const SplitVertices split = split_vertices(topology);
  source_vertices_ = split.vertices;
  has_uvs_ = !split.uvs.empty() && uvs.rows() > 0;
  if (has_uvs_) shared_data_ = encoded_texture_coordinates(split, uvs);
  if (influences.group_count() > 0)
    skin_attributes_ = skin_attributes(influences, source_vertices_);
  for (GlbSkinAttribute& one : skin_attributes_) shared_data_ += std::exchange(one.bytes, {});
  for (const GlbTriangles& group :
       triangles_by_material(split, polygon_materials, materials.size())) {
    append_array(shared_data_, group);
    index_counts_.push_back(3 * group.size());
  }
  for (const GlbImage& image : images) {
    shared_data_ += image.bytes;
    image_sizes_.push_back(image.bytes.size());
    images_.push_back({{}, image.type, image.name});
  }
  shared_data_.append((4 - shared_data_.size() % 4) % 4, '\0');
}

std::size_t GlbPart::add_to_scene(Json& scene, const Positions& positions,
                                  std::span<const Displacements> moves, const PartLook& look,
                                  std::size_t size) const {
  require(moves.size() == targets_.size(), "GlbPart: displacements of each target");
  const std::size_t vertices = source_vertices_.size();
  GlbBuffer buffer(scene, size);
  Json attributes = Json::object();
  attributes["POSITION"] = buffer.add_attribute(kFloat, "VEC3", vertices);
  set_bounds(scene["accessors"].back(), positions);
  attributes["NORMAL"] = buffer.add_attribute(kFloat, "VEC3", vertices);
  if (has_uvs_) attributes["TEXCOORD_0"] = buffer.add_attribute(kFloat, "VEC2", vertices);
  for (const GlbSkinAttribute& one : skin_attributes_)
    attributes[one.name] = buffer.add_attribute(one.component_type, "VEC4", vertices);
  const std::size_t first_texture = scene.contains("textures") ? scene["textures"].size() : 0;
  std::vector<GlbMaterial> materials = materials_;
  for (GlbMaterial& material : materials) {
    for (std::size_t c = 0; c < look.tint.size(); ++c) material.colour[c] *= look.tint[c];
    if (material.image) *material.image += first_texture;
  }
  Json primitives = buffer.add_primitives(index_counts_, attributes, materials);
  for (std::size_t i = 0; i < image_sizes_.size(); ++i) {
    add_image(scene, buffer.add_view(image_sizes_[i]), images_[i].name, images_[i].type);
  }
  buffer.pad();
  if (!look.image.empty()) {
    add_image(scene, buffer.add_view(look.image.size()), name_, "image/png");
    buffer.pad();
  }
  Json mesh = {{"name", name_}, {"primitives", std::move(primitives)}};
  set_morph_targets(mesh, scene["accessors"].size(), targets_);
  add_targets(moves, source_vertices_, topology_.vertex_count, scene, buffer);
  Json node = {{"name", name_}, {"mesh", scene["meshes"].size()}};
  if (skin_attributes_.empty()) {
    scene["nodes"][0]["children"].push_back(scene["nodes"].size());
  } else {
    node["skin"] = 0;
    scene["scenes"][0]["nodes"].push_back(scene["nodes"].size());
  }
  scene["nodes"].push_back(std::move(node));
  scene["meshes"].push_back(std::move(mesh));
  buffer.finish();
  return buffer.size();
}

void GlbPart::append_data(EncodedFile& file, const Positions& positions,
                          std::span<const Displacements> moves, const PartLook& look) const {
  require_finite(positions, topology_.vertex_count, name_);
  Positions normals = vertex_normals(fans_, topology_, positions);
  given_normals_.copy_to(normals);
  const std::size_t length = 2 * source_vertices_.size() * kVectorSize;
  char* const vectors = file.reserve(length);
  const std::span copied_vertices =
      std::span(source_vertices_).subspan(static_cast<std::size_t>(topology_.vertex_count));
  put_vectors(vectors, positions, copied_vertices);
  put_vectors(vectors + length / 2, normals, copied_vertices);
  file.add_without_copy({vectors, length});
  file.add_without_copy(shared_data_);
  if (!look.image.empty()) {
    file.add_without_copy(look.image);
    file.add(std::string((4 - look.image.size() % 4) % 4, '\0'));
  }
  for (const Displacements& target : moves) {
    require_finite(target.moves, target.moves.rows(), name_);
    const GlbMorphRows rows =
        morph_target_rows(target.vertices, source_vertices_, topology_.vertex_count);
    std::string bytes;
    for (const std::uint32_t vertex : rows.vertices) append_number(bytes, vertex);
    bytes.resize(bytes.size() + rows.rows.size() * kVectorSize);
    char* value = bytes.data() + rows.rows.size() * sizeof(std::uint32_t);
    for (const std::uint32_t row : rows.rows) value = put_row(value, target.moves, row);
    file.add(bytes);
  }
}

std::size_t GlbPart::encoding_memory_bytes() const {
  return 2 * source_vertices_.size() * kVectorSize +
         static_cast<std::size_t>(topology_.vertex_count) * 3 * sizeof(double) +
         targets_.size() * source_vertices_.size() * (sizeof(std::uint32_t) + kVectorSize);
}

}  // namespace crowdface
