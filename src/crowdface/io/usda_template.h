// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/glb_options.h"
#include "crowdface/io/usda_mesh.h"
#include "crowdface/io/usda_part.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Writes USD text layers (`.usda`) of one topology: a Mesh with its polygons, texture coordinates
/// as the primvar `st`, overlay coordinates as `st1`, material subsets bound to preview surfaces,
/// and UsdSkel blend shapes if there are targets. Positions keep their unit, which the layer states
/// as metersPerUnit. The stage's up axis is Y or Z; a transform rotates heads with another up axis
/// to Y. All text except vectors and names is formatted only once.
class UsdaTemplate {
 public:
  /// \param uvs  #T by 2; may be empty.
  /// \param options  as for GLB files, but images are external files and `vertex_ids` is ignored.
  UsdaTemplate(const Topology& topology, const TextureCoordinates& uvs, const GlbOptions& options,
               Subdivision subdivision);

  /// Encodes the layer of one face. The result references memory of this object.
  /// \param normals  #V by 3, unit; not written for meshes with subdivision.
  /// \param name  name of the face and of the root prim; characters that USD does not allow are
  ///              replaced.
  /// \param moves  for each blend shape, its displacements from `positions`.
  /// \param images  paths of the options' images, relative to the layer.
  /// \param points  #points by 3, in the positions' unit: child prims of the face's prim.
  /// \param parts  additional meshes, such as hair, which have the same blend shapes as the face.
  /// \param colours  #V, or no rows (see `UsdaMesh`).
  /// \throws InvalidInput if positions or normals are not #V by 3 or not finite.
  EncodedFile encode(const Positions& positions, const Positions& normals, const std::string& name,
                     std::span<const Displacements> moves = {},
                     std::span<const std::string> images = {}, const Positions& points = {},
                     std::span<const PlacedUsdaPart> parts = {},
                     const ColourRows& colours = {}) const;

  /// Memory used by this object, in bytes.
  std::size_t memory_bytes() const { return mesh_.memory_bytes(); }
  /// Memory needed to encode one file, in bytes.
  std::size_t encoding_memory_bytes() const { return mesh_.encoding_memory_bytes(); }

 private:
  /// Adds one child prim of the face's prim per point.
  /// \param points  #points by 3.
  void add_points(EncodedFile& file, const Positions& points, const std::string& what) const;

  UsdaMesh mesh_;               ///< the Mesh prim of the face
  std::string layer_metadata_;  ///< USD text with the layer's unit and up axis
  /// transform of the mesh if the stage's axes differ from the heads' axes; else empty
  std::string axis_transform_;
  /// Materials of the face; a copy of `GlbOptions::materials`.
  std::vector<GlbMaterial> glb_materials_;
  std::string shared_folder_;  ///< see `GlbOptions::shared_folder`
  /// for each of `GlbOptions::point_names`: the name of the point's prim
  std::vector<std::string> point_prim_names_;
};

/// Reads the positions of a file that `UsdaTemplate` wrote.
/// \param vertices  number of vertices of the topology.
/// \throws InvalidInput if another program wrote the file.
Positions read_usda_positions(const std::filesystem::path& path, Index vertices);

}  // namespace crowdface
