// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/glb_options.h"
#include "crowdface/io/glb_part.h"
#include "crowdface/io/glb_scene.h"
#include "crowdface/io/tangents.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Writes binary glTF 2.0 files of one topology. The constructor builds the data that all faces
/// share: texture coordinates, triangles, and vertices split at seams (see `SplitVertices`). Each
/// encoded file references this data. Positions keep their unit and axes. The attribute
/// `_VERTEX_ID` holds the index of the original vertex of each split vertex, or the value that
/// `GlbOptions::vertex_ids` gives for the original vertex. The first #V vertices of the file are
/// the original vertices in order. Files with a normal map have tangents.
class GlbTemplate {
 public:
  /// \param uvs  #T by 2, v upwards as in OBJ; may be empty.
  /// \throws InvalidInput if there are more vertices than `_VERTEX_ID` can distinguish: the
  /// attribute is single precision, which is exact up to 2²⁴.
  GlbTemplate(const Topology& topology, const TextureCoordinates& uvs, const GlbOptions& options);

  /// Encodes the file of one face. The result references memory of this object.
  /// \param normals  unit vectors, #V by 3. Always needed, because viewers use flat shading for a
  ///                 mesh without normals.
  /// \param name  name of the mesh in the file and in messages.
  /// \param moves  for each morph target, the displacements from `positions`.
  /// \param images  content of the image files, as many as the options declare; must outlive the
  ///                result.
  /// \param points  #points by 3, in the positions' unit.
  /// \param parts  additional meshes; must outlive the result.
  /// \param joints  #joints by 3, in the positions' unit.
  /// \param colours  vertex colours in sRGB, only if the options declare vertex colours. The file
  ///                 stores linear values.
  /// \throws InvalidInput if positions or normals are not #V by 3 or not finite.
  EncodedFile encode(const Positions& positions, const Positions& normals, const std::string& name,
                     std::span<const Displacements> moves = {},
                     std::span<const std::string_view> images = {}, const Positions& points = {},
                     std::span<const PlacedGlbPart> parts = {}, const Positions& joints = {},
                     const ColourRows& colours = {}) const;

  /// Memory used by this object, in bytes.
  std::size_t memory_bytes() const;
  /// Memory needed to encode one file, in bytes.
  std::size_t encoding_memory_bytes() const {
    return vertex_bytes() + target_bytes_ + skin_.matrix_bytes();
  }

 private:
  /// Number of bytes of one attribute of three numbers per vertex, such as the positions.
  std::size_t vector_attribute_bytes() const;
  /// Number of bytes of the positions, normals, colours and tangents of one file.
  std::size_t vertex_bytes() const {
    return (has_colours_ ? 3 : 2) * vector_attribute_bytes() +
           (tangents_ ? tangents_->count() * Tangents::kSize : 0);
  }

  Index vertex_count_;
  bool has_colours_;         ///< whether the encoded files have vertex colours
  std::size_t image_count_;  ///< number of `GlbOptions::images`
  Index point_count_;        ///< number of `GlbOptions::point_names`
  /// The original vertex of each split vertex with an index ≥ #V.
  std::vector<std::uint32_t> copied_vertices_;
  /// The tangents for normal mapping; nothing if no material has a normal map.
  std::optional<Tangents> tangents_;
  std::string shared_data_;            ///< the part of the buffer that is the same in all files
  std::vector<GlbMorphRows> targets_;  ///< the morph targets; `vertices` of each element is empty
  /// Index of the accessor of the first morph target's displacements; the accessors of further
  /// morph targets follow.
  std::size_t first_target_ = 0;
  GlbSkin skin_;  ///< the rig's joints; `influences` is empty
  /// Number of bytes of the displacements of all morph targets in one file.
  std::size_t target_bytes_ = 0;
  /// The scene as JSON, without the bounds and names, which differ from face to face.
  std::string json_;
};

/// Reads the positions of a file that `GlbTemplate` wrote.
/// \param vertices  number of vertices of the topology.
/// \throws InvalidInput if another program wrote the file.
Positions read_glb_positions(const std::filesystem::path& path, Index vertices);

}  // namespace crowdface
