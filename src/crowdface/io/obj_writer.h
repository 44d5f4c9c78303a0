// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/io/encoded_file.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Writes the target's own file with other positions, once: ObjTemplate says how.
/// \param topology   the faces, which all heads share; only read if the file has normals.
/// \param positions  #V by 3, in the file's unit.
/// \return           the digest of the bytes written.
/// \throws InvalidInput if positions are not #V by 3 or not finite; CannotCreate, IoError.
Digest write_obj_like(const ObjFile& target, const Topology& topology, const Positions& positions,
                      const std::filesystem::path& path);

/// A mesh of our own making as an OBJ file: positions, texture coordinates, faces.
/// \param comment    one line for the file's head, may be empty.
/// \param materials  of the faces, ascending; may be empty.
/// \param library    the file's name where they are defined, or empty.
/// \throws InvalidInput if positions are not #V by 3 or not finite.
EncodedFile encode_obj(const Mesh& mesh, const std::string& comment,
                       const std::vector<MaterialRange>& materials = {},
                       const std::string& library = {});

}  // namespace crowdface
