// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/obj_scan.h"
#include "crowdface/io/texture_kind.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A texture that lies in a mesh's file, or beside it under a name that the file gives.
struct MeshTexture {
  std::string material;
  TextureKind kind;
  std::string bytes;  ///< of an image file
};

/// A mesh as a file of any format has it: vertices and polygons in the file's order, in its unit and axes.
struct FileMesh : Mesh {
  Positions colours;                     ///< #V by 3, sRGB from 0 to 1; or no rows
  std::vector<MaterialRange> materials;  ///< of the faces, ascending; may be empty
  /// #V, of formats that split vertices at seams: which mesh of the file each is of. Empty: none is split.
  std::vector<std::uint32_t> pieces;
  std::vector<std::uint32_t>
      vertex_ids;  ///< #V, the vertices before they were split, if the file tells them
  std::vector<MeshTexture> textures;  ///< of its materials
  std::vector<std::string> notes;     ///< what was mended or left out, a sentence each
};

/// One vertex for all that a format split at seams: those of one id, or of one mesh at one place. Vertices keep the
/// order of the first of each; their texture coordinates become those of corners.
void join_split_vertices(FileMesh& mesh);

/// The same from a file's bytes. \param name  of the file, for messages.
FileMesh parse_ply(std::string_view bytes, const std::string& name);
FileMesh parse_stl(std::string_view bytes, const std::string& name);
/// glTF 2.0, as GLB or as JSON text: the triangles of all nodes of the scene, where the nodes stand.
FileMesh parse_gltf(std::string_view bytes, const std::filesystem::path& path);
/// USD as text: all Mesh prims that the layer defines itself, where they stand; no references, no variants, no frames.
FileMesh parse_usda(std::string_view text, const std::string& name);

}  // namespace crowdface
