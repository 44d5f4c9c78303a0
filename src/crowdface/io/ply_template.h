// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/io/encoded_file.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Writes binary little-endian PLY files of one topology: vertices in order with x y z and optional
/// nx ny nz as floats, then polygons of any size as `vertex_indices`. Files have no texture
/// coordinates: the only layout of texture coordinates that most programs read is one per vertex,
/// which would split vertices at seams and change the order of vertices.
class PlyTemplate {
 public:
  explicit PlyTemplate(const Topology& topology);

  /// Encodes the file of one face. The result references memory of this object.
  /// \param normals  #V by 3; no rows if the file has no normals.
  /// \param colours  red, green and blue of each vertex as bytes; no rows if the file has no
  ///                 colours.
  /// \param what  names the mesh in messages.
  /// \throws InvalidInput if positions are not finite.
  EncodedFile encode(const Positions& positions, const Positions& normals, const std::string& what,
                     const ColourRows& colours = {}) const;

  /// Memory used by this object, in bytes.
  std::size_t memory_bytes() const { return encoded_polygons_.size(); }
  /// Memory needed to encode one file with normals and colours, in bytes.
  std::size_t encoding_memory_bytes() const;

 private:
  Index vertex_count_;
  Index face_count_;
  bool has_small_polygons_ = true;  ///< whether no polygon has more than 255 corners
  std::string encoded_polygons_;    ///< the polygons, encoded as in the file
};

/// Reads the positions of a file that `PlyTemplate` wrote.
/// \throws InvalidInput if another program wrote the file.
Positions read_ply_positions(const std::filesystem::path& path);

}  // namespace crowdface
