// SPDX-License-Identifier: Apache-2.0
// Writes the GLB container (28 bytes around a JSON text and a buffer) without a library, so that
// the files of all faces share all arrays except positions and normals. tinygltf would copy each
// face's whole buffer several times (see tests/benchmarks/io_bench.cpp).
#include "crowdface/io/glb_template.h"

#include <algorithm>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/glb_container.h"
#include "crowdface/io/glb_scene.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/io/split_vertices.h"
#include "crowdface/io/srgb.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;
using namespace gltf;
using namespace glb;

std::string vertex_ids(const SplitVertices& split, const std::vector<std::uint32_t>& ids) {
  std::string bytes;
  bytes.reserve(split.vertices.size() * sizeof(float));
  // Store vertex ids as floats, because glTF forbids 32-bit integers for attributes and 16 bits are
  // too few.
  for (const std::uint32_t vertex : split.vertices) {
    append_number(bytes, static_cast<float>(ids.empty() ? vertex : ids[vertex]));
  }
  return bytes;
}

std::string places_on_overlay(const SplitVertices& split, const GlbOverlay& overlay) {
  std::string bytes;
  for (const std::uint32_t vertex : split.vertices) {
    for (const std::uint16_t place : overlay.uvs[vertex]) append_number(bytes, place);
  }
  return bytes;
}

Json attributes_json(GlbBuffer& buffer, std::size_t vertices, bool has_colours, bool has_tangents,
                     bool has_uvs, const std::vector<GlbSkinAttribute>& skin) {
  Json attributes = Json::object();
  const auto add = [&](const std::string& name, const char* type, int component = kFloat) {
    attributes[name] = buffer.add_attribute(component, type, vertices);
  };
  add("POSITION", "VEC3");
  add("NORMAL", "VEC3");
  if (has_colours) add("COLOR_0", "VEC3");
  if (has_tangents) add("TANGENT", "VEC4");
  if (has_uvs) add("TEXCOORD_0", "VEC2");
  add("_VERTEX_ID", "SCALAR");
  for (const GlbSkinAttribute& one : skin) add(one.name, "VEC4", one.component_type);
  return attributes;
}

/// Adds the images, which come last in the buffer. `place_images` later sets their sizes and
/// offsets for each file.
/// \param overlay  index of the buffer view of the overlay image; nothing without an overlay
void add_images(Json& scene, std::optional<std::size_t> overlay, const GlbOptions& options) {
  for (const GlbFaceImage& image : options.images) {
    add_image(scene, scene["bufferViews"].size(), image.suffix, image.type);
    scene["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 0}});
  }
  if (overlay) add_image(scene, *overlay, "iris", "image/png");
}

/// Sets the sizes and offsets of the images.
/// \param size  buffer size without the images.
/// \return buffer size with the images.
std::size_t place_images(Json& scene, std::size_t size, std::span<const std::string_view> images) {
  Json& views = scene["bufferViews"];
  for (std::size_t i = 0; i < images.size(); ++i) {
    Json& view = views[views.size() - images.size() + i];
    view["byteOffset"] = size;
    view["byteLength"] = images[i].size();
    size += images[i].size();
  }
  size += (4 - size % 4) % 4;
  scene["buffers"][0]["byteLength"] = size;
  return size;
}

}  // namespace

GlbTemplate::GlbTemplate(const Topology& topology, const TextureCoordinates& uvs,
                         const GlbOptions& options)
    : vertex_count_(topology.vertex_count),
      has_colours_(options.has_colours),
      image_count_(options.images.size()),
      point_count_(static_cast<Index>(options.point_names.size())) {
  constexpr Index kMaxVertices = 1 << 24;
  if (vertex_count_ > kMaxVertices || topology.face_count() == 0) {
    throw InvalidInput(concat("GLB: expected a mesh with faces and at most ", kMaxVertices,
                              " vertices, found ", vertex_count_, " vertices and ",
                              topology.face_count(), " faces"));
  }
  const bool has_normal_map = !topology.corner_uvs.empty() &&
                              std::ranges::any_of(options.materials, [](const GlbMaterial& one) {
                                return one.normal_image.has_value();
                              });
  const SplitVertices split =
      has_normal_map ? split_at_mirrored_uvs(topology, uvs) : split_vertices(topology);
  if (has_normal_map) tangents_.emplace(split, uvs);
  copied_vertices_.assign(split.vertices.begin() + vertex_count_, split.vertices.end());
  const std::vector<GlbTriangles> groups = triangles_by_material(
      split, options.polygon_materials, std::max<std::size_t>(1, options.materials.size()));
  std::vector<std::size_t> index_counts;
  for (const GlbTriangles& group : groups) index_counts.push_back(3 * group.size());

  Json scene;
  scene["asset"] = {{"version", "2.0"}, {"generator", "crowdface"}};
  scene["scene"] = 0;
  scene["scenes"] = Json::array({Json::object({{"nodes", Json::array({0})}})});
  scene["nodes"] = Json::array({root_node_json(options)});
  for (const std::string& point : options.point_names) {
    scene["nodes"][0]["children"].push_back(scene["nodes"].size());
    scene["nodes"].push_back({{"name", point}, {"translation", {0.0, 0.0, 0.0}}});
  }
  scene["buffers"] = Json::array({Json::object({{"byteLength", 0}})});
  GlbBuffer buffer(scene, 0);
  std::vector<GlbSkinAttribute> skin;
  if (!options.skin.joints.empty()) {
    skin = skin_attributes(options.skin.influences, split.vertices);
  }
  const Json attributes = attributes_json(buffer, split.vertices.size(), options.has_colours,
                                          has_normal_map, !split.uvs.empty(), skin);
  std::optional<std::size_t> places, picture;
  if (options.overlay) {
    require(options.overlay->uvs.size() == static_cast<std::size_t>(vertex_count_),
            "GlbTemplate: a place of each vertex on the overlay");
    places = buffer.add_attribute(kUnsignedShort, "VEC2", split.vertices.size());
    scene["accessors"][*places]["normalized"] = true;
  }
  scene["meshes"] = Json::array({Json::object({{"name", ""}})});
  scene["meshes"][0]["primitives"] = buffer.add_primitives(
      index_counts, attributes, options.materials, places, options.images.size());
  std::string indices;
  std::vector<std::size_t> views;
  for (const GlbMorphTarget& target : options.targets) {
    const std::size_t before = indices.size();
    targets_.push_back(morph_target_rows(target.vertices, split.vertices, vertex_count_));
    for (const std::uint32_t vertex : targets_.back().vertices) append_number(indices, vertex);
    targets_.back().vertices = {};
    if (target.vertices.empty()) continue;
    views.push_back(buffer.add_view(indices.size() - before));
  }
  if (options.overlay) {
    picture = buffer.add_view(options.overlay->png.size());
    indices += options.overlay->png;
    indices.append(buffer.pad(), '\0');
  }
  first_target_ = scene["accessors"].size();
  std::vector<std::string> names;
  for (std::size_t t = 0, view = 0; t < targets_.size(); ++t) {
    const std::size_t some = targets_[t].rows.size();
    buffer.add_zeros(split.vertices.size());
    if (some > 0) buffer.make_sparse(some, views[view++], buffer.add_view(some * kVectorSize));
    target_bytes_ += some * kVectorSize;
    names.push_back(options.targets[t].name);
  }
  set_morph_targets(scene["meshes"][0], first_target_, names);
  if (!options.skin.joints.empty()) {
    skin_.joints = options.skin.joints;
    buffer.add_view(skin_.matrix_bytes());
    add_joints(skin_, buffer.add_accessor(kFloat, "MAT4", skin_.joints.size()), scene);
    scene["scenes"][0]["nodes"].push_back(scene["nodes"].size());
    scene["nodes"].push_back({{"name", ""}, {"mesh", 0}, {"skin", 0}});
  }
  buffer.finish();
  add_images(scene, picture, options);
  json_ = scene.dump(-1, ' ', false, Json::error_handler_t::replace);

  shared_data_ = encoded_texture_coordinates(split, uvs) + vertex_ids(split, options.vertex_ids);
  for (const GlbSkinAttribute& one : skin) shared_data_ += one.bytes;
  if (options.overlay) shared_data_ += places_on_overlay(split, *options.overlay);
  for (const GlbTriangles& group : groups) append_array(shared_data_, group);
  shared_data_ += indices;
}

std::size_t GlbTemplate::vector_attribute_bytes() const {
  return (static_cast<std::size_t>(vertex_count_) + copied_vertices_.size()) * kVectorSize;
}

std::size_t GlbTemplate::memory_bytes() const {
  return shared_data_.size() + json_.size() +
         copied_vertices_.size() * sizeof(copied_vertices_[0]) +
         target_bytes_ / kVectorSize * sizeof(std::uint32_t) +
         (tangents_ ? tangents_->memory_bytes() : 0);
}

EncodedFile GlbTemplate::encode(const Positions& positions, const Positions& normals,
                                const std::string& name, std::span<const Displacements> moves,
                                std::span<const std::string_view> images, const Positions& points,
                                std::span<const PlacedGlbPart> parts, const Positions& joints,
                                const ColourRows& colours) const {
  require(moves.size() == targets_.size(), "GlbTemplate: displacements of each target");
  require(images.size() == image_count_, "a GLB file with ", images.size(), " images for ",
          image_count_);
  require_finite(positions, vertex_count_, name);
  require_finite(normals, vertex_count_, name);
  require(!has_colours_ || colours.rows() == vertex_count_, "GlbTemplate: a colour of each vertex");
  Json scene = Json::parse(json_);
  set_bounds(scene["accessors"][0], positions);
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    require_finite(moves[t].moves, moves[t].moves.rows(), name);
    set_displacement_bounds(scene["accessors"][first_target_ + t], moves[t],
                            targets_[t].moves_all_vertices);
  }
  require_finite(points, point_count_, name);
  for (Index p = 0; p < point_count_; ++p) {
    scene["nodes"][static_cast<std::size_t>(p + 1)]["translation"] = vector_json(points.row(p));
  }
  if (!skin_.joints.empty()) {
    require_finite(joints, static_cast<Index>(skin_.joints.size()), name);
    set_joint_positions(skin_, static_cast<std::size_t>(1 + point_count_), joints, scene);
    scene["nodes"].back()["name"] = name;
  }
  scene["nodes"][0]["name"] = name;
  scene["meshes"][0]["name"] = name;
  for (std::size_t i = 0; i < images.size(); ++i) {
    Json& called = scene["images"][i]["name"];
    called = name + called.get<std::string>();
  }
  const std::size_t arrays_size = encoding_memory_bytes() + shared_data_.size();
  const std::size_t own_size =
      images.empty() ? arrays_size : place_images(scene, arrays_size, images);
  std::size_t binary_size = own_size;
  for (const PlacedGlbPart& one : parts) {
    binary_size = one.part->add_to_scene(scene, *one.positions, one.moves, one.look, binary_size);
  }
  std::string json = scene.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.append((4 - json.size() % 4) % 4, ' ');

  const std::size_t total = kBinaryHeaderSize + json.size() + binary_size;
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidInput(concat(name, ": expected a GLB file of at most ",
                              std::numeric_limits<std::uint32_t>::max(), " bytes, found ", total));
  }
  std::string head;
  for (const auto number : {kMagic, kContainerVersion, static_cast<std::uint32_t>(total),
                            static_cast<std::uint32_t>(json.size()), kJsonChunk}) {
    append_number(head, number);
  }
  head += json;
  append_number(head, static_cast<std::uint32_t>(binary_size));
  append_number(head, kBinaryChunk);

  EncodedFile file;
  file.add(head);
  char* vectors = file.reserve(encoding_memory_bytes());
  put_vectors(vectors, positions, copied_vertices_);
  put_vectors(vectors + vector_attribute_bytes(), normals, copied_vertices_);
  char* const values = vectors + vertex_bytes();
  if (has_colours_)
    put_vectors(vectors + 2 * vector_attribute_bytes(), linear_light(colours), copied_vertices_);
  if (tangents_) {
    tangents_->write(values - tangents_->count() * Tangents::kSize, positions, normals);
  }
  file.add_without_copy({vectors, static_cast<std::size_t>(values - vectors)});
  file.add_without_copy(shared_data_);
  char* at = values;
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    for (const std::uint32_t row : targets_[t].rows) at = put_row(at, moves[t].moves, row);
  }
  if (!skin_.joints.empty()) put_bind_matrices(at, skin_, joints);
  file.add_without_copy({values, target_bytes_ + skin_.matrix_bytes()});
  std::size_t written = arrays_size;
  for (const std::string_view image : images) {
    file.add_without_copy(image);
    written += image.size();
  }
  file.add(std::string(own_size - written, '\0'));
  for (const PlacedGlbPart& one : parts) {
    one.part->append_data(file, *one.positions, one.moves, one.look);
  }
  return file;
}

Positions read_glb_positions(const std::filesystem::path& path, Index vertices) {
  const MappedFile file(path);
  const auto need = [&](bool is_so) {
    if (is_so) return;
    refuse_file(
        path,
        concat(
            "expected a GLB file as crowdface writes it for ", vertices,
            " vertices, found different contents; run crowdface generate to write the file again"));
  };
  const auto chunks = glb_chunks(file.bytes());
  need(chunks.has_value());
  const Json scene = Json::parse(chunks->json, nullptr, false);
  const Json generator = scene.value(Json::json_pointer("/asset/generator"), Json());
  need(generator == "crowdface");
  // The binary chunk begins with the positions.
  need(static_cast<std::size_t>(vertices) <= chunks->binary.size() / kVectorSize);
  return read_singles(chunks->binary.data(), vertices, kVectorSize, path.string());
}

}  // namespace crowdface
