// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include <Eigen/Geometry>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/file_mesh.h"
#include "crowdface/io/gltf_compression.h"
#include "crowdface/io/gltf_file.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/srgb.h"

namespace crowdface {
namespace {

using GltfJson = GltfFile::Json;

constexpr int kTriangles = 4, kStrip = 5, kFan = 6;

/// The vertex attributes that a primitive uses, and the corners of its triangles.
struct Primitive {
  std::vector<double> places, uvs, colours;
  std::size_t colour_width = 3;
  std::vector<std::uint32_t> ids, corners;
};

/// The transform of texture coordinates (KHR_texture_transform).
struct UvTransform {
  std::size_t set = 0;
  double x = 0, y = 0, rotation = 0, scale_x = 1, scale_y = 1;
  auto key() const { return std::tie(set, x, y, rotation, scale_x, scale_y); }
  bool operator<(const UvTransform& other) const { return key() < other.key(); }
};

/// The vertices of one accessor, as a range of rows in the list of all vertices of the file.
struct VertexRange {
  std::uint32_t first = 0, count = 0;
  /// The sets of texture coordinates of the range's vertices. The key of a set is its accessor and
  /// its transform. The reader appends each set to the list of all texture coordinates of the file;
  /// the map's value is the row of the range's first vertex in this list. The value is kNoIndex if
  /// the set does not have one pair of coordinates for each vertex.
  std::map<std::pair<std::size_t, UvTransform>, std::uint32_t> first_uvs;
};

class GltfMeshReader {
 public:
  GltfMeshReader(std::string_view bytes, const std::filesystem::path& path)
      : file_(bytes, path), path_(path) {}

  FileMesh read() {
    const GltfJson& scene = file_.scene();
    refuse_unknown_extensions();
    const GltfJson& nodes = scene.at("nodes");
    const std::vector<std::uint32_t> parents = file_.parents();
    const std::vector<Eigen::Matrix4d> worlds = file_.world_transforms(parents);
    const std::vector<bool> in_scene = nodes_of_scene(parents);
    std::vector<std::string> hidden;
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      if (!in_scene[n] || !nodes[n].contains("mesh")) continue;
      if (is_hidden(n, parents)) {
        hidden.push_back(nodes[n].value("name", concat("node ", n)));
        continue;
      }
      // The joints of a skinned mesh replace the transform of its node (glTF 2.0, section 3.7.3).
      const bool bound = nodes[n].contains("skin");
      joint_transforms_.clear();
      if (bound) {
        joint_transforms_ = file_.joint_transforms(nodes[n]["skin"].get<std::size_t>(), worlds);
      }
      add_mesh(nodes[n], bound ? Eigen::Matrix4d::Identity() : worlds[n]);
    }
    if (points_.empty() && !hidden.empty()) {
      file_.fail(concat("expected a mesh that is shown, found only hidden nodes: ", join(hidden),
                        "; show the head and export again"));
    }
    if (!hidden.empty()) {
      mesh_.notes.push_back(concat("its hidden meshes are not used: ", join(hidden)));
    }
    finish();
    read_texture_files(std::move(texture_files_), path_, mesh_);
    return std::move(mesh_);
  }

 private:
  /// Rejects a file that requires an unknown extension, as glTF 2.0 (section 3.12) demands.
  /// Required extensions that do not affect meshes are accepted.
  void refuse_unknown_extensions() const {
    constexpr std::array<std::string_view, 6> kRead = {
        "KHR_draco_mesh_compression", "KHR_mesh_quantization", "EXT_meshopt_compression",
        "KHR_meshopt_compression",    "KHR_texture_transform", "KHR_node_visibility"};
    constexpr std::array<std::string_view, 12> kNotOfMeshes = {
        "KHR_materials_", "KHR_technique",  "KHR_texture_", "EXT_texture_",
        "MSFT_texture_",  "MSFT_packing_",  "KHR_lights_",  "EXT_lights_",
        "KHR_xmp",        "KHR_animation_", "KHR_node_",    "VRM"};
    std::vector<std::string> unknown;
    for (const GltfJson& one : file_.scene().value("extensionsRequired", GltfJson::array())) {
      const auto name = one.get<std::string>();
      const auto begins = [&](std::string_view start) { return name.starts_with(start); };
      if (std::ranges::find(kRead, name) != kRead.end()) continue;
      if (std::ranges::none_of(kNotOfMeshes, begins)) unknown.push_back(name);
    }
    if (unknown.empty()) return;
    file_.fail(concat("it requires glTF extensions that are not read: ", join(unknown),
                      "; export it without them"));
  }

  std::vector<bool> nodes_of_scene(const std::vector<std::uint32_t>& parents) const {
    const GltfJson& scene = file_.scene();
    if (!scene.contains("scenes") || scene["scenes"].empty()) {
      return std::vector<bool>(parents.size(), true);
    }
    std::vector<bool> shown(parents.size(), false);
    const GltfJson& roots = scene["scenes"].at(scene.value("scene", std::size_t{0}));
    for (const GltfJson& node : roots.value("nodes", GltfJson::array())) {
      shown.at(node.get<std::size_t>()) = true;
    }
    for (std::uint32_t n = 0; n < parents.size(); ++n) {
      for (std::uint32_t above = n; above != kNoIndex && !shown[n]; above = parents[above]) {
        if (shown[above]) shown[n] = true;
      }
    }
    return shown;
  }

  /// Whether the extension KHR_node_visibility hides the node or a node above it. Nodes form no
  /// cycle (see GltfFile::world_transforms).
  bool is_hidden(std::uint32_t node, const std::vector<std::uint32_t>& parents) const {
    const GltfJson& nodes = file_.scene().at("nodes");
    for (; node != kNoIndex; node = parents[node]) {
      const GltfJson extensions = nodes[node].value("extensions", GltfJson::object());
      if (!extensions.contains("KHR_node_visibility")) continue;
      if (!extensions["KHR_node_visibility"].value("visible", true)) return true;
    }
    return false;
  }

  UvTransform uv_transform(const GltfJson& primitive) const {
    UvTransform transform;
    if (!primitive.contains("material")) return transform;
    const GltfJson& material =
        file_.scene().at("materials").at(primitive["material"].get<std::size_t>());
    const GltfJson* texture = nullptr;
    if (material.contains("pbrMetallicRoughness") &&
        material["pbrMetallicRoughness"].contains("baseColorTexture")) {
      texture = &material["pbrMetallicRoughness"]["baseColorTexture"];
    }
    if (texture == nullptr) return transform;
    transform.set = texture->value("texCoord", std::size_t{0});
    if (!texture->contains("extensions") ||
        !(*texture)["extensions"].contains("KHR_texture_transform")) {
      return transform;
    }
    const GltfJson& by = (*texture)["extensions"]["KHR_texture_transform"];
    transform.set = by.value("texCoord", transform.set);
    const auto offset = by.value("offset", std::vector<double>{0, 0});
    const auto scale = by.value("scale", std::vector<double>{1, 1});
    transform.x = offset.at(0);
    transform.y = offset.at(1);
    transform.scale_x = scale.at(0);
    transform.scale_y = scale.at(1);
    transform.rotation = by.value("rotation", 0.0);
    return transform;
  }

  std::string material_name(const GltfJson& primitive, const std::string& mesh) const {
    if (!primitive.contains("material")) return mesh;
    const auto number = primitive["material"].get<std::size_t>();
    return file_.scene().at("materials").at(number).value("name", concat("material_", number));
  }

  void add_mesh(const GltfJson& node, const Eigen::Matrix4d& world_transform) {
    const auto number = node["mesh"].get<std::size_t>();
    const GltfJson& mesh = file_.scene().at("meshes").at(number);
    const std::string name = node.value("name", mesh.value("name", concat("mesh_", number)));
    weights_ = node.value("weights", mesh.value("weights", std::vector<double>()));
    std::map<std::size_t, VertexRange> known;
    for (const GltfJson& primitive : mesh.at("primitives")) {
      const int mode = primitive.value("mode", kTriangles);
      if (mode < kTriangles || mode > kFan) continue;  // points and lines
      add_primitive(primitive, mode, world_transform, material_name(primitive, name), known);
    }
    ++piece_;
  }

  /// Adds the vertices and triangles of a primitive to the mesh.
  /// \param known  maps an accessor to the vertices that earlier primitives of the same mesh added
  ///                for this accessor
  void add_primitive(const GltfJson& json, int mode, const Eigen::Matrix4d& world_transform,
                     const std::string& material, std::map<std::size_t, VertexRange>& known) {
    const GltfJson& attributes = json.at("attributes");
    const auto accessor = attributes.at("POSITION").get<std::size_t>();
    const UvTransform transform = uv_transform(json);
    const std::string uv_set = concat("TEXCOORD_", transform.set);
    const bool packed =
        json.contains("extensions") && json["extensions"].contains("KHR_draco_mesh_compression");
    VertexRange unshared{static_cast<std::uint32_t>(pieces()), 0, {}};
    VertexRange& rows = packed ? unshared : known.try_emplace(accessor, unshared).first->second;
    std::uint32_t first_uv = kNoIndex;
    Primitive part;
    if (rows.count > 0) {
      part.corners = corners_of(json, rows.count);
    } else {
      part = packed ? unpack(json, uv_set) : read(json);
      rows.count = static_cast<std::uint32_t>(part.places.size() / 3);
      add_rows(part, world_transform);
    }
    if (packed) {
      first_uv = add_uvs(part.uvs, rows.count, transform);
    } else if (attributes.contains(uv_set)) {
      const auto uvs = attributes[uv_set].get<std::size_t>();
      const auto [first, is_new] = rows.first_uvs.try_emplace({uvs, transform}, kNoIndex);
      if (is_new) first->second = add_uvs(file_.read_values(uvs, 2), rows.count, transform);
      first_uv = first->second;
    }
    for (const std::uint32_t corner : part.corners) {
      if (corner >= rows.count) {
        file_.fail(concat("a triangle refers to vertex ", corner, " of ", rows.count));
      }
    }
    add_faces(part.corners, mode, rows.first, first_uv, world_transform, material);
  }

  std::size_t pieces() const { return mesh_.mesh_of_vertex.size(); }

  Primitive read(const GltfJson& json) {
    const GltfJson& attributes = json.at("attributes");
    const auto rows = [&](const std::string& name, std::size_t width) {
      return file_.read_values(attributes.at(name).get<std::size_t>(), width);
    };
    Primitive part;
    part.places = rows("POSITION", 3);
    move_by_targets(json, part.places);
    if (!joint_transforms_.empty() && attributes.contains("JOINTS_0")) {
      move_by_joints(file_.read_skin_weights(attributes, part.places.size() / 3), part.places);
    }
    if (attributes.contains("COLOR_0")) {
      part.colour_width = colour_width(attributes);
      part.colours = rows("COLOR_0", part.colour_width);
    }
    if (attributes.contains("_VERTEX_ID")) {
      part.ids = file_.read_unsigned_values(attributes.at("_VERTEX_ID").get<std::size_t>(), 1);
    }
    part.corners = corners_of(json, static_cast<std::uint32_t>(part.places.size() / 3));
    return part;
  }

  /// Adds the displacements of the morph targets, times the default weights of the node or mesh, to
  /// the positions.
  void move_by_targets(const GltfJson& primitive, std::vector<double>& places) {
    const GltfJson targets = primitive.value("targets", GltfJson::array());
    std::size_t unused = 0;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const double weight = t < weights_.size() ? weights_[t] : 0;
      if (weight == 0) ++unused;
      if (weight == 0 || !targets[t].contains("POSITION")) continue;
      const auto moves = file_.read_values(targets[t]["POSITION"].get<std::size_t>(), 3);
      if (moves.size() != places.size()) {
        file_.fail("a morph target and POSITION differ in length");
      }
      for (std::size_t i = 0; i < places.size(); ++i) places[i] += weight * moves[i];
    }
    unused_targets_ = std::max(unused_targets_, unused);
  }

  /// Places the vertices of a skinned mesh in the rest pose. If all weights of a vertex are zero,
  /// the vertex follows the first joint in the vertex's own list of joints (JOINTS_0).
  void move_by_joints(const GltfSkinWeights& by, std::vector<double>& places) {
    for (std::size_t p = 0; p < places.size() / 3; ++p) {
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      double sum = 0;
      const auto add = [&](std::size_t i, double weight) {
        const std::size_t joint = by.joints[i / 4][4 * p + i % 4];
        place += weight * transform_point(joint_transforms_.at(joint), &places[3 * p]);
        sum += weight;
      };
      for (std::size_t i = 0; i < 4 * by.joints.size(); ++i) {
        const double weight = by.weights[i / 4][4 * p + i % 4];
        if (weight > 0) add(i, weight);
      }
      if (sum == 0) add(0, 1);
      for (std::size_t k = 0; k < 3; ++k) places[3 * p + k] = place[static_cast<Index>(k)] / sum;
    }
  }

  std::vector<std::uint32_t> corners_of(const GltfJson& json, std::uint32_t count) {
    if (json.contains("indices")) {
      return file_.read_unsigned_values(json.at("indices").get<std::size_t>(), 1);
    }
    std::vector<std::uint32_t> corners(count);
    std::iota(corners.begin(), corners.end(), 0U);
    return corners;
  }

  /// Number of colour components that the attribute COLOR_0 has.
  std::size_t colour_width(const GltfJson& attributes) const {
    const GltfJson& accessor =
        file_.scene().at("accessors").at(attributes.at("COLOR_0").get<std::size_t>());
    return accessor.value("type", std::string()) == "VEC4" ? 4 : 3;
  }

  /// Converts colours to fractions. Draco data may contain the integers that encode the fractions.
  static std::vector<double> fractions_of_colours(std::vector<double> colours) {
    constexpr double kMaxByte = 255, kMaxShort = 65535;
    const double most = colours.empty() ? 0 : *std::ranges::max_element(colours);
    if (most <= 1) return colours;
    for (double& colour : colours) colour /= most > kMaxByte ? kMaxShort : kMaxByte;
    return colours;
  }

  Primitive unpack(const GltfJson& json, const std::string& uv_set) {
    const GltfJson& packed = json["extensions"]["KHR_draco_mesh_compression"];
    const GltfJson& ids = packed.at("attributes");
    Primitive part;
    std::vector<DracoAttribute> wanted;
    std::vector<std::string> names;
    const auto want = [&](const std::string& name, std::size_t width) {
      if (!ids.contains(name)) return;
      wanted.push_back({ids[name].get<std::uint32_t>(), width});
      names.push_back(name);
    };
    ids.at("POSITION");
    want("POSITION", 3);
    want(uv_set, 2);
    if (ids.contains("COLOR_0")) part.colour_width = colour_width(json.at("attributes"));
    want("COLOR_0", part.colour_width);
    for (std::size_t set = 0; ids.contains(concat("JOINTS_", set)); ++set) {
      want(concat("JOINTS_", set), 4);
      want(concat("WEIGHTS_", set), 4);
    }
    auto mesh = decode_draco(file_.view(packed.at("bufferView").get<std::size_t>()), wanted);
    if (!mesh) {
      file_.fail(
          "it is compressed with Draco (KHR_draco_mesh_compression) and cannot be unpacked; "
          "gltf-transform copy in.glb out.glb writes it without compression");
    }
    std::map<std::string, std::vector<double>> values;
    for (std::size_t a = 0; a < names.size(); ++a)
      values[names[a]] = std::move(mesh->attributes[a]);
    part.places = std::move(values["POSITION"]);
    part.uvs = std::move(values[uv_set]);
    part.colours = fractions_of_colours(std::move(values["COLOR_0"]));
    GltfSkinWeights skin;
    for (std::size_t set = 0; ids.contains(concat("JOINTS_", set)); ++set) {
      std::vector<std::uint32_t>& joints = skin.joints.emplace_back();
      for (const double joint : values[concat("JOINTS_", set)]) {
        joints.push_back(static_cast<std::uint32_t>(std::clamp<double>(joint, 0, kNoIndex)));
      }
      skin.weights.push_back(std::move(values[concat("WEIGHTS_", set)]));
      if (skin.weights.back().empty()) file_.fail("a mesh lacks WEIGHTS_n");
    }
    move_by_targets(json, part.places);
    if (!joint_transforms_.empty() && !skin.joints.empty()) move_by_joints(skin, part.places);
    part.corners = std::move(mesh->corners);
    return part;
  }

  /// Appends the texture coordinates of `count` vertices, and returns the row of the first vertex.
  /// Appends nothing and returns kNoIndex if `uvs` does not have two numbers per vertex.
  std::uint32_t add_uvs(const std::vector<double>& uvs, std::size_t count, const UvTransform& by) {
    if (uvs.size() != 2 * count) return kNoIndex;
    const auto first = static_cast<std::uint32_t>(uvs_.size() / 2);
    const double cos = std::cos(by.rotation), sin = std::sin(by.rotation);
    for (std::size_t i = 0; i < count; ++i) {
      const double u = uvs[2 * i] * by.scale_x, v = uvs[2 * i + 1] * by.scale_y;
      uvs_.push_back(cos * u + sin * v + by.x);
      uvs_.push_back(1 - (-sin * u + cos * v + by.y));  // converts to v upwards, as in OBJ
    }
    return first;
  }

  void add_rows(const Primitive& part, const Eigen::Matrix4d& world_transform) {
    const std::size_t count = part.places.size() / 3;
    const bool has_colours = part.colours.size() == part.colour_width * count;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d point = transform_point(world_transform, &part.places[3 * i]);
      points_.insert(points_.end(), point.data(), point.data() + 3);
      mesh_.mesh_of_vertex.push_back(piece_);
      for (std::size_t c = 0; c < 3; ++c) {
        colours_.push_back(has_colours ? srgb_of_linear(part.colours[part.colour_width * i + c])
                                       : 1);
      }
    }
    any_colours_ = any_colours_ || has_colours;
    has_ids_ = has_ids_ && part.ids.size() == count;
    mesh_.vertex_ids.insert(mesh_.vertex_ids.end(), part.ids.begin(), part.ids.end());
  }

  /// Adds the triangles of a primitive to the mesh.
  /// \param first, first_uv  rows of the first vertex and of its texture coordinates
  void add_faces(const std::vector<std::uint32_t>& corners, int mode, std::uint32_t first,
                 std::uint32_t first_uv, const Eigen::Matrix4d& world_transform,
                 const std::string& material) {
    const bool mirrored = world_transform.topLeftCorner<3, 3>().determinant() < 0;
    if (mesh_.materials.empty() || mesh_.materials.back().name != material) {
      mesh_.materials.push_back({material, mesh_.topology.face_count()});
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      if (mirrored) std::swap(b, c);
      for (const std::uint32_t corner : {a, b, c}) {
        mesh_.topology.corner_vertices.push_back(first + corner);
        mesh_.topology.corner_uvs.push_back(first_uv == kNoIndex ? kNoIndex : first_uv + corner);
      }
      mesh_.topology.face_offsets.push_back(
          static_cast<std::uint32_t>(mesh_.topology.corner_vertices.size()));
    };
    for (std::size_t i = 0; i + 2 < corners.size(); i += mode == kTriangles ? 3 : 1) {
      if (mode == kTriangles) {
        add(corners[i], corners[i + 1], corners[i + 2]);
      } else if (mode == kFan) {
        add(corners[0], corners[i + 1], corners[i + 2]);
      } else {
        const std::size_t odd = i % 2;
        const std::uint32_t a = corners[i], b = corners[i + 1 + odd], c = corners[i + 2 - odd];
        if (a != b && b != c && c != a) add(a, b, c);
      }
    }
  }

  void finish() {
    set_vertex_data(mesh_, points_, uvs_, any_colours_ ? colours_ : std::vector<double>());
    if (!has_ids_) mesh_.vertex_ids.clear();
    if (unused_targets_ > 0) {
      mesh_.notes.push_back(shapes_note(unused_targets_, "morph targets"));
    }
    std::set<std::string> used, unused;
    for (const MaterialRange& range : mesh_.materials) used.insert(range.name);
    const GltfJson& scene = file_.scene();
    if (!scene.contains("materials")) return;
    for (std::size_t m = 0; m < scene["materials"].size(); ++m) {
      const GltfJson& material = scene["materials"][m];
      const std::string name = material.value("name", concat("material_", m));
      if (!used.contains(name)) continue;
      if (material.contains("pbrMetallicRoughness")) {
        const GltfJson& look = material["pbrMetallicRoughness"];
        const auto factor = look.value("baseColorFactor", std::vector<float>(4, 1.0F));
        if (factor.size() < 3) file_.fail("expected a baseColorFactor of four numbers");
        mesh_.material_colours[material_name_of(name)] = {factor[0], factor[1], factor[2]};
        add_texture(look, "baseColorTexture", name, TextureKind::kColour);
      }
      const char* gloss = "KHR_materials_pbrSpecularGlossiness";
      if (material.contains("extensions") && material["extensions"].contains(gloss)) {
        add_texture(material["extensions"][gloss], "diffuseTexture", name, TextureKind::kColour);
      }
      add_texture(material, "normalTexture", name, TextureKind::kNormal);
      note_unused_textures(material, unused);
    }
    if (!unused.empty()) {
      mesh_.notes.push_back(concat("its textures of these kinds are not used: ",
                                   join({unused.begin(), unused.end()})));
    }
  }

  /// Adds to `unused` the glTF names of textures that the material has but that generated faces
  /// cannot have.
  static void note_unused_textures(const GltfJson& material, std::set<std::string>& unused) {
    const auto add = [&](const GltfJson& from, const char* key) {
      if (from.contains(key)) unused.insert(key);
    };
    for (const char* key : {"occlusionTexture", "emissiveTexture"}) add(material, key);
    if (material.contains("pbrMetallicRoughness")) {
      add(material["pbrMetallicRoughness"], "metallicRoughnessTexture");
    }
    if (!material.contains("extensions")) return;
    for (const auto& [extension, values] : material["extensions"].items()) {
      for (const auto& [key, value] : values.items()) {
        if (key.ends_with("Texture") && key != "diffuseTexture") unused.insert(key);
      }
    }
  }

  /// Adds the texture that a JSON object refers to under `key` to a material.
  /// \param from  JSON object that may have a texture reference under `key`
  void add_texture(const GltfJson& from, const char* key, const std::string& material,
                   TextureKind kind) {
    if (!from.contains(key)) return;
    try {
      const GltfJson& scene = file_.scene();
      const GltfJson& texture = scene.at("textures").at(from[key].at("index").get<std::size_t>());
      const GltfJson* source = &texture;
      for (const char* packed : {"KHR_texture_basisu", "EXT_texture_webp"}) {
        if (source->contains("source") || !texture.contains("extensions")) break;
        if (texture["extensions"].contains(packed)) source = &texture["extensions"][packed];
      }
      const GltfJson& image = scene.at("images").at(source->at("source").get<std::size_t>());
      const auto uri = image.value("uri", std::string());
      const bool is_outside = !uri.empty() && !uri.starts_with("data:");
      MeshTexture added{material, kind, {}};
      if (uri.empty()) {
        added.bytes = file_.view(image.at("bufferView").get<std::size_t>());
      } else if (!is_outside) {
        added.bytes = file_.read_uri(uri, "its texture");
      }
      mesh_.textures.push_back(std::move(added));
      texture_files_.push_back(is_outside ? percent_decoded(uri).value_or(uri) : "");
    } catch (const std::exception& error) {
      mesh_.notes.push_back(concat("the ", mtl_statement_of(kind).name, " texture of ",
                                   quoted(material), " cannot be read: ", error.what()));
    }
  }

  GltfFile file_;
  const std::filesystem::path& path_;
  FileMesh mesh_;
  /// For each texture, the path of its image file; empty if the glTF file embeds the image.
  std::vector<std::string> texture_files_;
  std::vector<double> points_, uvs_, colours_;
  /// GltfFile::joint_transforms for the skin of the current mesh; empty if the mesh has no skin
  std::vector<Eigen::Matrix4d> joint_transforms_;
  std::vector<double> weights_;  ///< weights of the morph targets of the mesh being read
  /// the largest number of morph targets of weight 0 in one primitive
  std::size_t unused_targets_ = 0;
  std::uint32_t piece_ = 0;
  bool any_colours_ = false, has_ids_ = true;
};

}  // namespace

FileMesh parse_gltf(std::string_view bytes, const std::filesystem::path& path) {
  try {
    return GltfMeshReader(bytes, path).read();
  } catch (const GltfJson::exception& error) {
    refuse_file(path, concat("expected a valid glTF 2.0 scene: ", error.what()));
  } catch (const std::out_of_range&) {
    refuse_file(path, "it refers to nodes or accessors that it does not have");
  }
}

}  // namespace crowdface
