// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <exception>
#include <initializer_list>
#include <optional>
#include <set>
#include <utility>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "crowdface/io/fbx_reader.h"

namespace crowdface {
namespace {

struct Collected {
  FileMesh& mesh;
  std::vector<double> points, uvs, colours;
  std::uint32_t piece = 0;
  bool any_colours = false;
  std::string hidden;  ///< names of hidden nodes with meshes, separated by commas
};

void collect_mesh(const aiMesh& from, const aiMatrix4x4& world_transform,
                  const std::string& material, Collected& all) {
  constexpr unsigned kMinCorners = 3;
  FileMesh& mesh = all.mesh;
  const auto first = static_cast<std::uint32_t>(all.points.size() / 3);
  const bool has_uvs = from.HasTextureCoords(0), has_colours = from.HasVertexColors(0);
  all.any_colours = all.any_colours || has_colours;
  for (unsigned v = 0; v < from.mNumVertices; ++v) {
    const aiVector3D point = world_transform * from.mVertices[v];
    all.points.insert(all.points.end(), {point.x, point.y, point.z});
    const aiVector3D uv = has_uvs ? from.mTextureCoords[0][v] : aiVector3D();
    all.uvs.insert(all.uvs.end(), {uv.x, uv.y});
    const aiColor4D colour = has_colours ? from.mColors[0][v] : aiColor4D(1, 1, 1, 1);
    for (const float c : {colour.r, colour.g, colour.b}) {
      all.colours.push_back(std::clamp<double>(c, 0, 1));
    }
    mesh.mesh_of_vertex.push_back(all.piece);
  }
  const bool mirrored = aiMatrix3x3(world_transform).Determinant() < 0;
  if (mesh.materials.empty() || mesh.materials.back().name != material) {
    mesh.materials.push_back({material, mesh.topology.face_count()});
  }
  for (unsigned f = 0; f < from.mNumFaces; ++f) {
    const aiFace& face = from.mFaces[f];
    if (face.mNumIndices < kMinCorners) continue;
    for (unsigned c = 0; c < face.mNumIndices; ++c) {
      const std::uint32_t vertex = first + face.mIndices[mirrored ? face.mNumIndices - 1 - c : c];
      mesh.topology.corner_vertices.push_back(vertex);
      mesh.topology.corner_uvs.push_back(has_uvs ? vertex : kNoIndex);
    }
    mesh.topology.face_offsets.push_back(
        static_cast<std::uint32_t>(mesh.topology.corner_vertices.size()));
  }
}

/// Whether the node's property `Show` is off or its property `Visibility` is zero.
bool is_hidden(const aiNode& node) {
  bool shown = true;
  float visibility = 1;
  if (node.mMetaData == nullptr) return false;
  return (node.mMetaData->Get("Show", shown) && !shown) ||
         (node.mMetaData->Get("Visibility", visibility) && visibility == 0);
}

/// Collects the meshes of a node and of the nodes below it. If a node is hidden, collects only its
/// name.
/// \param above  transform from the axes of the node's parent to the axes of the file
/// \param hidden  whether a parent of the node is hidden
void collect_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, bool hidden,
                  int depth, Collected& all) {
  constexpr int kDeepest = 2048;
  if (depth > kDeepest) throw std::runtime_error("its nodes are nested too deeply");
  const aiMatrix4x4 world_transform = above * node.mTransformation;
  hidden = hidden || is_hidden(node);
  if (hidden && node.mNumMeshes > 0)
    all.hidden += (all.hidden.empty() ? "" : ", ") + std::string(node.mName.C_Str());
  for (unsigned m = 0; m < node.mNumMeshes && !hidden; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    const aiString name = mesh.mMaterialIndex < scene.mNumMaterials
                              ? scene.mMaterials[mesh.mMaterialIndex]->GetName()
                              : mesh.mName;
    collect_mesh(mesh, world_transform, name.C_Str(), all);
  }
  if (node.mNumMeshes > 0) ++all.piece;
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    collect_node(scene, *node.mChildren[c], world_transform, hidden, depth + 1, all);
  }
}

/// The kind of texture that a material property of FBX refers to, such as `DiffuseColor`,
/// `Maya|normalCamera` or `3dsMax|main|norm_map`; nothing for kinds that generated faces do not
/// have.
std::optional<TextureKind> kind_of_property(std::string_view property) {
  property.remove_prefix(property.rfind('|') + 1);  // npos + 1 is 0
  std::string name(property);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto is_any_of = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
  };
  if (is_any_of({"diffusecolor", "diffusetexture", "diffuse_map", "basecolor", "base_color_map",
                 "tex_color_map"})) {
    return TextureKind::kColour;
  }
  if (name.find("norm") != name.npos) return TextureKind::kNormal;
  if (name.find("rough") != name.npos && !name.starts_with("diff")) return TextureKind::kRoughness;
  if (is_any_of({"specularcolor", "specularfactor", "speculartexture", "specular_map"})) {
    return TextureKind::kSpecular;
  }
  if (name.starts_with("displacement")) return TextureKind::kDisplacement;
  if (name.starts_with("bump")) return TextureKind::kBump;
  return std::nullopt;
}

/// Adds a texture to a material unless the material already has a texture of this kind. For an
/// external texture, stores only the file name (in `external_textures`), not the bytes.
/// \return  false if the material already has a different texture of this kind.
bool add_texture(const aiScene& scene, const std::string& material, TextureKind kind,
                 const aiString& name, FileMesh& mesh,
                 std::vector<std::string>& external_textures) {
  const aiTexture* texture = scene.GetEmbeddedTexture(name.C_Str());
  // In Assimp, an embedded texture of height 0 is a compressed image file of mWidth bytes.
  const bool is_inside = texture != nullptr && texture->mHeight == 0;
  MeshTexture added{
      material, kind,
      is_inside ? std::string(reinterpret_cast<const char*>(texture->pcData), texture->mWidth)
                : std::string()};
  const std::string file = is_inside ? "" : name.C_Str();
  for (std::size_t t = 0; t < mesh.textures.size(); ++t) {
    const MeshTexture& known = mesh.textures[t];
    if (known.material != material || known.kind != kind) continue;
    return known.bytes == added.bytes && external_textures[t] == file;
  }
  external_textures.push_back(file);
  mesh.textures.push_back(std::move(added));
  return true;
}

void collect_textures(const aiScene& scene, FileMesh& mesh,
                      std::vector<std::string>& external_textures) {
  constexpr std::string_view kPrefix = "$raw.", kSuffix = "|file";
  std::set<std::string> unused;
  for (unsigned m = 0; m < scene.mNumMaterials; ++m) {
    const aiMaterial& material = *scene.mMaterials[m];
    const std::string material_name = material.GetName().C_Str();
    for (unsigned p = 0; p < material.mNumProperties; ++p) {
      const aiMaterialProperty& property = *material.mProperties[p];
      std::string_view key = property.mKey.C_Str();
      aiString name;
      if (!key.starts_with(kPrefix) || !key.ends_with(kSuffix) ||
          material.Get(property.mKey.C_Str(), property.mSemantic, property.mIndex, name) !=
              aiReturn_SUCCESS) {
        continue;
      }
      key.remove_prefix(kPrefix.size());
      key.remove_suffix(kSuffix.size());
      const auto kind = kind_of_property(key);
      if (!kind || !add_texture(scene, material_name, *kind, name, mesh, external_textures)) {
        unused.emplace(key.substr(key.rfind('|') + 1));
      }
    }
    // The loop above does not find layered textures. For a layered texture, `GetTexture` returns
    // the lowest layer.
    for (const auto& [type, kind] : {std::pair(aiTextureType_DIFFUSE, TextureKind::kColour),
                                     std::pair(aiTextureType_NORMALS, TextureKind::kNormal)}) {
      aiString name;
      if (material.GetTexture(type, 0, &name) != aiReturn_SUCCESS) continue;
      add_texture(scene, material_name, kind, name, mesh, external_textures);
    }
  }
  if (unused.empty()) return;
  std::string names;
  for (const std::string& name : unused) names += (names.empty() ? "" : ", ") + name;
  mesh.notes.push_back("its textures of these properties are not used: " + names);
}

/// Adds a note that the blend shapes in the file are ignored: the program reads each blend shape
/// from a separate mesh file.
void note_shapes(const aiScene& scene, FileMesh& mesh) {
  std::set<std::string> shapes;
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    for (unsigned a = 0; a < scene.mMeshes[m]->mNumAnimMeshes; ++a) {
      shapes.insert(scene.mMeshes[m]->mAnimMeshes[a]->mName.C_Str());
    }
  }
  if (!shapes.empty()) mesh.notes.push_back(shapes_note(shapes.size(), "blend shapes"));
}

void read(std::string_view bytes, FileMesh& mesh, std::vector<std::string>& external_textures) {
  Assimp::Importer importer;
  // With this default, Assimp makes one node for each part of a transform, such as a pivot or a
  // rotation. Without it, Assimp 5.2 also moves the children of a node by the node's geometric
  // offset, and places nodes with post-rotations wrongly.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "fbx");
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw std::runtime_error(importer.GetErrorString());
  }
  Collected all{mesh, {}, {}, {}, 0, false, {}};
  collect_node(*scene, *scene->mRootNode, aiMatrix4x4(), false, 0, all);
  const auto rows = static_cast<Index>(mesh.mesh_of_vertex.size());
  mesh.topology.vertex_count = rows;
  mesh.positions = Eigen::Map<const Positions>(all.points.data(), rows, 3);
  mesh.uvs = Eigen::Map<const TextureCoordinates>(all.uvs.data(), rows, 2);
  if (all.any_colours) mesh.colours = Eigen::Map<const Positions>(all.colours.data(), rows, 3);
  const auto& corners = mesh.topology.corner_uvs;
  if (std::ranges::count(corners, kNoIndex) == std::ssize(corners)) {
    mesh.topology.corner_uvs.clear();
    mesh.uvs.resize(0, 2);
  }
  collect_textures(*scene, mesh, external_textures);
  note_shapes(*scene, mesh);
  if (!all.hidden.empty()) {
    mesh.notes.push_back("its hidden meshes are not used: " + all.hidden);
  }
}

}  // namespace
}  // namespace crowdface

extern "C" __attribute__((visibility("default"))) bool crowdface_read_fbx(
    std::string_view bytes, crowdface::FileMesh& mesh, std::vector<std::string>& external_textures,
    std::string& error) {
  try {
    crowdface::read(bytes, mesh, external_textures);
    return true;
  } catch (const std::exception& failure) {
    error = failure.what();
    return false;
  }
}
