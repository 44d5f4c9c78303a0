// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "crowdface/wrap/scan.h"

namespace crowdface {

/// Reads the geometry of a scan: OBJ, PLY (text or binary), STL (text or binary) or GLB, told by the
/// name's ending. Vertices that stand in one place are welded; their numbers are those of the file
/// (of an STL file: of its corners in order; of a GLB file: of its primitives one after the other).
/// \throws MissingInput; InvalidInput naming file, what was expected and what was found.
Scan read_scan(const std::filesystem::path& path);

/// The same from a file's bytes. \param name  of the file, for messages.
Scan parse_ply(std::string_view bytes, const std::string& name);
Scan parse_stl(std::string_view bytes, const std::string& name);
/// Triangles of all nodes of the scene, where the nodes stand. Buffers lie in the file itself;
/// compressed primitives are refused.
Scan parse_glb(std::string_view bytes, const std::string& name);

}  // namespace crowdface
