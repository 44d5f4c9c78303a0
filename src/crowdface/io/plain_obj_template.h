// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/io/encoded_file.h"
#include "crowdface/io/obj_scan.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// OBJ files of our own making over one topology: after a head of lines the positions, normals if they
/// are asked for, texture coordinates, and faces under the names of their materials.
class PlainObjTemplate {
 public:
  enum class Normals { kNone, kVertex };

  /// \param uvs        #T by 2, may be empty.
  /// \param materials  of the faces, ascending; may be empty.
  PlainObjTemplate(const Topology& topology, const TextureCoordinates& uvs,
                   const std::vector<MaterialRange>& materials, Normals normals);

  /// The file with these positions; refers to this object.
  /// \param head     whole lines, or nothing.
  /// \param normals  #V by 3, only with Normals::kVertex.
  /// \param what     names the mesh in messages.
  /// \throws InvalidInput if positions are not #V by 3 or not finite.
  EncodedFile encode(const std::string& head, const Positions& positions, const Positions& normals,
                     const std::string& what) const;

  /// What this object itself takes, and what one encode takes.
  std::size_t memory_bytes() const { return shared_.size(); }
  std::size_t encode_bytes() const;

 private:
  Index vertices_;
  Normals normals_;
  std::string shared_;  ///< texture coordinates and faces
};

}  // namespace crowdface
