// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "crowdface/io/encoded_file.h"
#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Binary PLY files (little endian) of one topology: vertices in their order with x y z and, if
/// asked for, nx ny nz as floats; then the faces as they are, quads and larger polygons included,
/// as `vertex_indices`. There are no texture coordinates: what programs agree to read is one a
/// vertex; seams would split vertices, and their order would be lost.
class PlyTemplate {
 public:
  /// \throws InvalidInput if a face has more than 255 corners.
  explicit PlyTemplate(const Topology& topology);

  /// The file with these positions; refers to this object.
  /// \param normals  #V by 3, or no rows: the file has none.
  /// \param colours  #V, or no rows, likewise: red, green and blue as bytes.
  /// \param what     names the mesh in messages.
  /// \throws InvalidInput if positions are not finite.
  EncodedFile encode(const Positions& positions, const Positions& normals, const std::string& what,
                     const ColourRows& colours = {}) const;

  /// What this object itself takes.
  std::size_t memory_bytes() const { return faces_.size(); }
  /// What one encode takes, with normals and colours.
  std::size_t encode_bytes() const;

 private:
  Index vertices_;
  Index face_count_;
  std::string faces_;  ///< as they stand in the file
};

/// The positions of a file that PlyTemplate made. \throws InvalidInput if it is any other.
Positions read_ply_positions(const std::filesystem::path& path);

}  // namespace crowdface
