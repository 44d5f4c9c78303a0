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
#include "crowdface/heads/head_texture_files.h"
#include "crowdface/io/file_mesh.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/wrap/scan.h"

namespace crowdface {

/// The textures of one kind, such as colour maps, that the polygons of a mesh use.
struct MeshMaps {
  /// all textures, one per texture file
  std::vector<std::unique_ptr<const FilteredTexture>> textures;
  /// for each polygon, an index into `textures`, or kNoIndex; may be empty
  std::vector<std::uint32_t> texture_of_polygon;
  /// for each polygon: lower left corner (u, v) of the unit square of texture space that contains
  /// the polygon's centre
  std::vector<std::array<std::int32_t, 2>> tile_of_polygon;
};

/// Reads texture files, and marks the texels that the polygons cover.
/// \throws InvalidInput naming a damaged file.
MeshMaps read_mesh_maps(const HeadTextureFiles& textures, TextureKind kind,
                        const Topology& topology, const TextureCoordinates& uvs);

/// A point of a scan, and the parallelogram around this point that one texel covers.
struct ScanArea {
  std::uint32_t triangle = 0;  ///< index of the scan's triangle that contains the point
  /// barycentric coordinates of the point in this triangle
  std::array<double, 3> barycentric = {};
  /// Vectors from the texel to its right neighbour and to its lower neighbour, in the scan's frame.
  Eigen::Vector3d to_right_texel, to_lower_texel;
};

/// The colours of a scan. If the scan has textures, the colours come from the textures; otherwise
/// from its vertices, or else from its materials.
class ScanColours {
 public:
  /// \param mesh  the file's mesh; its positions are not used.
  /// \param file  path of the mesh file.
  ScanColours(FileMesh mesh, const std::filesystem::path& file);

  /// Whether at least one polygon has a colour.
  bool has_colours() const { return has_colours_; }
  bool has_vertex_colours() const { return vertex_linear_colours_.rows() > 0; }
  /// Messages about missing or unreadable files.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Returns the mean colour of an area in linear light; nothing if the polygon that contains
  /// the area has no colour.
  /// \param scan  the geometry that was read from the same mesh file as these colours, in any
  /// frame.
  std::optional<Eigen::Array3f> mean_at(const Scan& scan, const ScanArea& area) const;

 private:
  /// A triangle of the file: a polygon, and the numbers of three corners within this polygon.
  struct TriangleCorners {
    std::uint32_t face = 0;  ///< index of the file's polygon from which the triangle was cut
    std::uint32_t first = 0, second = 0, third = 0;
  };

  /// a set without heads that holds the topology and the texture coordinates of the scan's file
  HeadSet mesh_;
  std::vector<TriangleCorners> triangle_corners_;  ///< all triangles of the file
  MeshMaps colours_;                               ///< the file's colour textures
  /// #V by 3: colours of vertices in linear light; or no rows
  ColourValues vertex_linear_colours_;
  /// colour of each material in linear light; nothing if the material has no colour
  std::vector<std::optional<std::array<float, 3>>> material_linear_colours_;
  /// index of the material of each polygon; or empty
  std::vector<std::uint32_t> material_of_polygon_;
  std::vector<std::string> warnings_;
  bool has_colours_ = false;
};

/// The colours at the vertices of a scan, grey where a polygon has no colour. No rows if the scan
/// has no colours.
ColourRows colours_at_vertices(const Scan& scan, const ScanColours& colours);

}  // namespace crowdface
