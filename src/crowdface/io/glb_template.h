// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/glb_options.h"
#include "crowdface/io/glb_part.h"
#include "crowdface/io/glb_scene.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Binary glTF 2.0 files of one topology. What all faces share (texture coordinates, triangles,
/// the split of vertices at seams; see SplitVertices) is made once and referred to by each file.
/// Positions stay in their own unit and axes. The attribute `_VERTEX_ID` holds the original vertex
/// of each, or what is given for it; the first #V vertices are the original ones in their order.
class GlbTemplate {
 public:
  /// \param uvs  #T by 2, v upwards as in OBJ; may be empty.
  /// \throws InvalidInput if there are more vertices than `_VERTEX_ID` can tell apart: it is single
  ///         precision, which counts to 2²⁴.
  GlbTemplate(const Topology& topology, const TextureCoordinates& uvs, const GlbOptions& options);

  /// The file with these positions; refers to this object.
  /// \param normals  #V by 3, unit; always needed, because a viewer shades a mesh without them flat.
  /// \param name     of the mesh, in the file and in messages.
  /// \param points   #points by 3, in the positions' unit.
  /// \param images   files, as many as the options say; must outlive the result.
  /// \param parts    what stands beside the face; must outlive the result.
  /// \param joints   #joints by 3, as points.
  /// \param colours  #V, if the options say that files have some; written as linear light.
  /// \throws InvalidInput if positions or normals are not #V by 3 or not finite.
  /// \param moves    #targets: of their vertices, from `positions`.
  EncodedFile encode(const Positions& positions, const Positions& normals, const std::string& name,
                     std::span<const Displacements> moves = {},
                     std::span<const std::string_view> images = {}, const Positions& points = {},
                     std::span<const PlacedGlbPart> parts = {}, const Positions& joints = {},
                     const ColourRows& colours = {}) const;

  /// What this object itself takes.
  std::size_t memory_bytes() const;
  /// What one encode takes.
  std::size_t encode_bytes() const {
    return (colours_ ? 3 : 2) * vector_bytes() + target_bytes_ + skin_.matrix_bytes();
  }

 private:
  std::size_t vector_bytes() const;

  Index vertices_;
  bool colours_;
  std::size_t images_;
  Index points_;
  std::vector<std::uint32_t> split_;    ///< original vertices of the split ones from #V on
  std::string shared_;                  ///< the part of the buffer that all faces share
  std::vector<GlbTargetRows> targets_;  ///< without the vertices
  std::size_t first_target_ = 0;        ///< the accessor of its moves; those of others follow
  GlbSkin skin_;                        ///< without influences
  std::size_t target_bytes_ = 0;        ///< of the values of all targets
  std::string json_;                    ///< the scene of any face; bounds and names to be filled in
};

/// The positions of a file that GlbTemplate made. \throws InvalidInput if it is any other.
/// \param vertices  #V of the topology it was made for.
Positions read_glb_positions(const std::filesystem::path& path, Index vertices);

}  // namespace crowdface
