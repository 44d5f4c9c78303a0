// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/bake/filtered_texture.h"
#include "crowdface/heads/attachment_textures.h"
#include "crowdface/io/file_mesh.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/wrap/scan.h"

namespace crowdface {

/// The textures of one kind that the polygons of a mesh use.
struct MeshMaps {
  std::vector<std::unique_ptr<const FilteredTexture>> files;
  std::vector<std::uint32_t> of_face;             ///< #F, index into `files` or kNoIndex; or empty
  std::vector<std::array<std::int32_t, 2>> tile;  ///< #F: lower corner of the polygon's unit square
};

/// Reads the textures that `placed` names and marks the texels that the polygons cover.
/// \throws InvalidInput naming a damaged file.
MeshMaps read_mesh_maps(const AttachmentTextures& placed, TextureKind kind,
                        const Topology& topology, const TextureCoordinates& uvs);

/// A point of a scan, and the area around it that one texel shows.
struct ScanArea {
  std::uint32_t triangle = 0;         ///< of the scan
  std::array<double, 3> shares = {};  ///< barycentric coordinates of the point
  /// The change of place from the texel to its right and to its lower neighbour, in the scan's
  /// frame.
  Eigen::Vector3d across, down;
};

/// The colours of a scan: of textures, of vertices, or of whole materials, in this order.
class ScanColours {
 public:
  /// \param mesh  the file's mesh; its positions are not used.
  /// \param file  of the mesh.
  ScanColours(FileMesh mesh, const std::filesystem::path& file);

  /// Whether any polygon has a colour.
  bool any() const { return any_; }
  bool at_vertices() const { return light_.rows() > 0; }
  /// Messages about missing or unreadable files.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// The texture files that are used.
  const std::vector<std::filesystem::path>& files() const { return paths_; }

  /// The mean colour of an area in linear light; nothing if its polygon has no colour.
  /// \param scan  made from the file; in any frame.
  std::optional<Eigen::Array3f> at(const Scan& scan, const ScanArea& area) const;

 private:
  struct Source {
    std::uint32_t face = 0, first = 0, second = 0, third = 0;  ///< polygon, and its corners
  };

  HeadSet faces_;                ///< topology and texture coordinates of the file
  std::vector<Source> sources_;  ///< #triangles of the file
  MeshMaps colours_;
  Positions light_;  ///< #V: colours of vertices in linear light; or no rows
  std::vector<std::optional<std::array<float, 3>>> material_light_;  ///< #materials
  std::vector<std::uint32_t> material_;                              ///< #F; or empty
  std::vector<std::filesystem::path> paths_;
  std::vector<std::string> warnings_;
  bool any_ = false;
};

/// The colours at the vertices of a scan; grey where a polygon has none. No rows if the scan has no colours.
ColourRows colours_at_vertices(const Scan& scan, const ScanColours& colours);

}  // namespace crowdface
