// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/given_normals.h"
#include "crowdface/io/glb_options.h"
#include "crowdface/io/part_look.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// An image embedded in the file.
struct GlbImage {
  std::string bytes;  ///< content of the image file
  std::string type;   ///< "image/png" or "image/jpeg"
  std::string name = {};
};

/// An additional mesh, such as hair, in the GLB files of faces, with its own topology, materials
/// and images. Its node is a child of the face's node. Like a `GlbTemplate`, this object is built
/// once; for each face, only positions, normals and displacements of the morph targets are written.
class GlbPart {
 public:
  /// \param uvs  #T by 2, v upwards as in OBJ; may be empty.
  /// \param materials  at least one. `GlbMaterial::image` is an index into `images`; if the index
  ///                   equals the number of `images`, the material uses `PartLook::image`.
  /// \param polygon_materials  for each polygon, the index of its material in `materials`.
  /// \param influences  for each vertex, the weights of the rig's joints; empty if the mesh is not
  ///                    skinned.
  /// \param targets  names of the morph targets.
  /// \param fixed  normals that replace the computed normals of some vertices.
  GlbPart(std::string name, const Topology& topology, const TextureCoordinates& uvs,
          const std::vector<GlbMaterial>& materials,
          const std::vector<std::uint32_t>& polygon_materials, const std::vector<GlbImage>& images,
          const CompressedRows<Influence>& influences = {}, std::vector<std::string> targets = {},
          GivenNormals fixed = {});

  /// Adds the part's node, mesh, materials and accessors to a scene.
  /// \param size  bytes in the buffer so far, a multiple of four.
  /// \param moves  for each morph target, the displacements of this mesh's vertices.
  /// \return the buffer size afterwards, a multiple of four.
  std::size_t add_to_scene(nlohmann::ordered_json& scene, const Positions& positions,
                           std::span<const Displacements> moves, const PartLook& look,
                           std::size_t size) const;
  /// Appends the data that `add_to_scene` declares. `file` references memory of this object.
  /// \throws InvalidInput if positions are not #V by 3 or not finite.
  void append_data(EncodedFile& file, const Positions& positions,
                   std::span<const Displacements> moves, const PartLook& look) const;

  std::size_t memory_bytes() const { return shared_data_.size(); }
  /// Upper bound of the memory needed to encode one file, in bytes. Counts the positions, the
  /// normals with their double-precision intermediate values, and morph targets in which every
  /// vertex moves.
  std::size_t encoding_memory_bytes() const;

 private:
  std::string name_;
  Topology topology_;
  NormalFans fans_;  ///< for each vertex, the polygons from which its normal is computed
  /// For each split vertex (see SplitVertices), its original vertex.
  std::vector<std::uint32_t> source_vertices_;
  bool has_uvs_;
  /// For each material, the number of vertex indices of its triangles.
  std::vector<std::size_t> index_counts_;
  std::vector<GlbMaterial> materials_;
  std::vector<std::size_t> image_sizes_;  ///< number of bytes of each image file
  // The `bytes` of the images and of the skin attributes are empty; `shared_data_` has the data.
  std::vector<GlbImage> images_;
  /// The attributes JOINTS_n and WEIGHTS_n; empty if the mesh is not skinned.
  std::vector<GlbSkinAttribute> skin_attributes_;
  std::vector<std::string> targets_;  ///< names of the morph targets
  GivenNormals given_normals_;        ///< normals that replace computed normals
  /// bytes that are the same for all faces: texture coordinates, influences, triangles, images
  std::string shared_data_;
};

/// A `GlbPart` and its positions for one face.
struct PlacedGlbPart {
  const GlbPart* part;
  const Positions* positions;  ///< positions of the part's vertices on this face, #V by 3
  /// for each morph target, the displacements of the part's vertices
  std::span<const Displacements> moves = {};
  PartLook look = {};
};

}  // namespace crowdface
