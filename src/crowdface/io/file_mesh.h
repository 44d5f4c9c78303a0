// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/obj_scan.h"
#include "crowdface/io/texture_kind.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A texture that a mesh file embeds or names.
struct MeshTexture {
  std::string material;  ///< name of the material
  TextureKind kind;
  std::string bytes;  ///< content of the image file
};

/// A mesh as read from a file of any format. Vertices and polygons have the order of the file;
/// positions have the unit and axes of the file.
struct FileMesh : Mesh {
  ColourValues colours;  ///< vertex colours: #V by 3, sRGB from 0 to 1; or no rows
  /// Ranges of polygons with the same material, in ascending order; may be empty.
  std::vector<MaterialRange> materials;
  /// For each vertex, the index of its mesh in the file. Empty for formats that do not split
  /// vertices at seams.
  std::vector<std::uint32_t> mesh_of_vertex;
  /// For each vertex, the id of the unsplit vertex of which it is a copy. Empty if the file has no
  /// ids.
  std::vector<std::uint32_t> vertex_ids;
  std::vector<MeshTexture> textures;  ///< textures that the materials of the mesh use
  /// Base colours in linear light, by name of the material, for formats without material files.
  std::map<std::string, std::array<float, 3>> material_colours;
  /// Material files that an OBJ file names. Empty for other formats, which list their textures in
  /// `textures`.
  std::vector<std::string> material_libraries;
  /// Sentences for the user about repairs and about ignored content.
  std::vector<std::string> notes;
};

/// Sets the vertices, texture coordinates and vertex colours of a mesh. If there are no texture
/// coordinates, clears the corners' indices of texture coordinates.
/// \param points, colours  three numbers per vertex; `colours` may be empty
/// \param uvs              two numbers per texture coordinate
void set_vertex_data(FileMesh& mesh, const std::vector<double>& points,
                     const std::vector<double>& uvs, const std::vector<double>& colours);

/// The text of a note that says that blend shapes inside a mesh file are ignored: the program reads
/// each blend shape from a separate mesh file (docs/shapes.md).
inline std::string shapes_note(std::size_t count, std::string_view kind) {
  return "its " + std::to_string(count) + ' ' + std::string(kind) +
         " are not used: export each as a mesh of its own for `shapes`";
}

/// Merges vertices that a format has split at seams. Two vertices of the same mesh are copies of
/// one vertex if they have the same id. In a file without ids, two vertices are copies if both lie
/// on the mesh's border at the same position (see joined_borders). The merged vertices have the
/// order of their first copies. Texture coordinates move from vertices to polygon corners. Adds a
/// note if vertices were merged.
/// \return whether any vertices were merged.
bool join_split_vertices(FileMesh& mesh);

/// Parses a PLY file.
/// \param name  name of the file, for messages.
FileMesh parse_ply(std::string_view bytes, const std::string& name);
/// Parses an STL file.
/// \param name  name of the file, for messages.
FileMesh parse_stl(std::string_view bytes, const std::string& name);
/// Parses glTF 2.0 (GLB or JSON text): the triangles of all nodes of the scene, with each node's
/// transform applied.
FileMesh parse_gltf(std::string_view bytes, const std::filesystem::path& path);
/// Parses USD text: all Mesh prims that the layer itself defines, with their transforms applied.
/// Ignores references, variants and animation.
FileMesh parse_usda(std::string_view text, const std::string& name);

}  // namespace crowdface
