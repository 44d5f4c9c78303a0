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

/// Encodes a copy of the target's file with other positions (see `ObjTemplate`).
/// \param topology  the polygons, which all heads share; only used if the file has normals.
/// \param positions  #V by 3, in the file's unit.
/// \param what  names the mesh in messages.
/// \throws InvalidInput if positions are not #V by 3 or not finite.
EncodedFile encode_obj_like(const ObjFile& target, const Topology& topology,
                            const Positions& positions, const std::string& what);
/// Writes the text that encode_obj_like returns.
/// \return digest of the bytes written.
/// \throws InvalidInput like encode_obj_like; CannotCreate, IoError.
Digest write_obj_like(const ObjFile& target, const Topology& topology, const Positions& positions,
                      const std::filesystem::path& path);

/// Encodes a mesh as a new OBJ file with positions, texture coordinates and polygons.
/// \param comment  one line for the start of the file; may be empty.
/// \param materials  materials of the polygons, ascending first_face; may be empty.
/// \param library  name of the material file; may be empty.
/// \throws InvalidInput if positions are not #V by 3 or not finite.
EncodedFile encode_obj(const Mesh& mesh, const std::string& comment,
                       const std::vector<MaterialRange>& materials = {},
                       const std::string& library = {});

}  // namespace crowdface
