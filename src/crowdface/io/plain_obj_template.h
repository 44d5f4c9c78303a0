// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/obj_scan.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Writes new OBJ files of one topology. A file has header lines, positions, optional normals,
/// texture coordinates, and polygons grouped by material.
class PlainObjTemplate {
 public:
  /// Whether files have no normals or one normal per vertex.
  enum class Normals { kNone, kVertex };

  /// \param uvs  #T by 2; may be empty.
  /// \param materials  materials of the polygons, ascending first_face; may be empty.
  PlainObjTemplate(const Topology& topology, const TextureCoordinates& uvs,
                   const std::vector<MaterialRange>& materials, Normals normals);

  /// Encodes the file of one face. The result references memory of this object.
  /// \param header  the first lines of the file, each with its line end; may be empty.
  /// \param normals  #V by 3, only with Normals::kVertex.
  /// \param what  names the mesh in messages.
  /// \throws InvalidInput if positions are not #V by 3 or not finite.
  EncodedFile encode(const std::string& header, const Positions& positions,
                     const Positions& normals, const std::string& what) const;

  /// Memory used by this object, in bytes.
  std::size_t memory_bytes() const { return shared_text_.size(); }
  /// Memory needed to encode one file, in bytes.
  std::size_t encoding_memory_bytes() const;

 private:
  Index vertex_count_;
  Normals normals_;  ///< whether files have no normals or one normal per vertex
  /// the lines of texture coordinates and polygons, the same in all files
  std::string shared_text_;
};

}  // namespace crowdface
