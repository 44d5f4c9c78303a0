// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <exception>
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
};

void collect_mesh(const aiMesh& from, const aiMatrix4x4& place, const std::string& material,
                  Collected& all) {
  constexpr unsigned kMinCorners = 3;
  FileMesh& mesh = all.mesh;
  const auto first = static_cast<std::uint32_t>(all.points.size() / 3);
  const bool has_uvs = from.HasTextureCoords(0), has_colours = from.HasVertexColors(0);
  all.any_colours = all.any_colours || has_colours;
  for (unsigned v = 0; v < from.mNumVertices; ++v) {
    const aiVector3D point = place * from.mVertices[v];
    all.points.insert(all.points.end(), {point.x, point.y, point.z});
    const aiVector3D uv = has_uvs ? from.mTextureCoords[0][v] : aiVector3D();
    all.uvs.insert(all.uvs.end(), {uv.x, uv.y});
    const aiColor4D colour = has_colours ? from.mColors[0][v] : aiColor4D(1, 1, 1, 1);
    for (const float c : {colour.r, colour.g, colour.b}) {
      all.colours.push_back(std::clamp<double>(c, 0, 1));
    }
    mesh.pieces.push_back(all.piece);
  }
  const bool mirrored = aiMatrix3x3(place).Determinant() < 0;
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

void collect_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, int depth,
                  Collected& all) {
  constexpr int kDeepest = 256;
  if (depth > kDeepest) throw std::runtime_error("its nodes are nested too deeply");
  const aiMatrix4x4 place = above * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    const aiString name = mesh.mMaterialIndex < scene.mNumMaterials
                              ? scene.mMaterials[mesh.mMaterialIndex]->GetName()
                              : mesh.mName;
    collect_mesh(mesh, place, name.C_Str(), all);
  }
  if (node.mNumMeshes > 0) ++all.piece;
  for (unsigned c = 0; c < node.mNumChildren; ++c) {
    collect_node(scene, *node.mChildren[c], place, depth + 1, all);
  }
}

/// For external textures, stores only the file names in `beside`, not the bytes.
void collect_textures(const aiScene& scene, FileMesh& mesh, std::vector<std::string>& beside) {
  for (unsigned m = 0; m < scene.mNumMaterials; ++m) {
    const aiMaterial& material = *scene.mMaterials[m];
    for (const auto& [type, kind] : {std::pair(aiTextureType_DIFFUSE, TextureKind::kColour),
                                     std::pair(aiTextureType_NORMALS, TextureKind::kNormal)}) {
      aiString name;
      if (material.GetTexture(type, 0, &name) != aiReturn_SUCCESS) continue;
      const aiTexture* texture = scene.GetEmbeddedTexture(name.C_Str());
      // A height of 0 means a compressed image file.
      const bool is_inside = texture != nullptr && texture->mHeight == 0;
      beside.emplace_back(is_inside ? "" : name.C_Str());
      mesh.textures.push_back(
          {material.GetName().C_Str(), kind,
           is_inside ? std::string(reinterpret_cast<const char*>(texture->pcData), texture->mWidth)
                     : std::string()});
    }
  }
}

void read(std::string_view bytes, FileMesh& mesh, std::vector<std::string>& beside) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, false);
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "fbx");
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw std::runtime_error(importer.GetErrorString());
  }
  Collected all{mesh, {}, {}, {}};
  collect_node(*scene, *scene->mRootNode, aiMatrix4x4(), 0, all);
  const auto rows = static_cast<Index>(mesh.pieces.size());
  mesh.topology.vertex_count = rows;
  mesh.positions = Eigen::Map<const Positions>(all.points.data(), rows, 3);
  mesh.uvs = Eigen::Map<const TextureCoordinates>(all.uvs.data(), rows, 2);
  if (all.any_colours) mesh.colours = Eigen::Map<const Positions>(all.colours.data(), rows, 3);
  const auto& corners = mesh.topology.corner_uvs;
  if (std::ranges::count(corners, kNoIndex) == std::ssize(corners)) {
    mesh.topology.corner_uvs.clear();
    mesh.uvs.resize(0, 2);
  }
  collect_textures(*scene, mesh, beside);
}

}  // namespace
}  // namespace crowdface

extern "C" __attribute__((visibility("default"))) bool crowdface_read_fbx(
    std::string_view bytes, crowdface::FileMesh& mesh, std::vector<std::string>& beside,
    std::string& error) {
  try {
    crowdface::read(bytes, mesh, beside);
    return true;
  } catch (const std::exception& failure) {
    error = failure.what();
    return false;
  }
}
