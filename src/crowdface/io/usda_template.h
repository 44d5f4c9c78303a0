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

/// USD layers (text, `.usda`) of one topology: a Mesh with its faces as they are, texture coordinates
/// as the primvar `st`, places on an overlay as `st1`, material subsets bound to preview surfaces, and blend shapes of UsdSkel where
/// there are targets. Positions stay in their own unit, which metersPerUnit tells; the stage's up axis
/// is Y or Z, and a transform turns other heads to Y. All but the vectors and names is made once.
class UsdaTemplate {
 public:
  /// \param uvs      #T by 2; may be empty.
  /// \param options  as of a GLB file, but that images are files beside; `vertex_ids` is not written.
  UsdaTemplate(const Topology& topology, const TextureCoordinates& uvs, const GlbOptions& options,
               Subdivision subdivision);

  /// The layer with these positions; refers to this object.
  /// \param normals  #V by 3, unit; not written for meshes that are subdivided.
  /// \param name     of the face; the root prim is called so, as far as USD allows.
  /// \param moves    #targets: of their vertices, from `positions`.
  /// \param points   #points by 3, in the positions' unit: prims below the face's.
  /// \param images   the options' images, relative to the layer.
  /// \param parts    further meshes, with the same targets.
  /// \param colours  #V, or no rows: see UsdaMesh.
  /// \throws InvalidInput if positions or normals are not #V by 3 or not finite.
  EncodedFile encode(const Positions& positions, const Positions& normals, const std::string& name,
                     std::span<const Displacements> moves = {},
                     std::span<const std::string> images = {}, const Positions& points = {},
                     std::span<const PlacedUsdaPart> parts = {},
                     const ColourRows& colours = {}) const;

  /// What this object itself takes, and what one encode takes.
  std::size_t memory_bytes() const { return mesh_.memory_bytes(); }
  std::size_t encode_bytes() const { return mesh_.encode_bytes(); }

 private:
  void add_points(EncodedFile& file, const Positions& points, const std::string& what) const;

  UsdaMesh mesh_;
  std::string frame_;  ///< of the layer: unit and axis
  std::string turn_;   ///< of the mesh, where the stage's axes are others
  std::vector<GlbMaterial> surfaces_;
  std::string shared_;               ///< see GlbOptions
  std::vector<std::string> points_;  ///< prims' names of the points
};

/// The positions of a file that UsdaTemplate made. \throws InvalidInput if it is any other.
/// \param vertices  #V of the topology it was made for.
Positions read_usda_positions(const std::filesystem::path& path, Index vertices);

}  // namespace crowdface
