// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "crowdface/io/file_mesh.h"
#include "crowdface/wrap/scan.h"

namespace crowdface {

/// Reads the geometry of a scan in any format of `read_mesh`. Merges vertices with equal positions:
/// the triangles use only one of them. But all vertices of the file keep their rows and indices
/// (for STL: the corners in order; for glTF: the primitives one after the other).
/// \throws MissingInput; InvalidInput naming file, what was expected and what was found.
Scan read_scan(const std::filesystem::path& path);
/// Converts a mesh read from `path` to a scan. Moves the positions and the notes (sentences about
/// repairs) out of the mesh. Flips the mesh's polygons if the mesh is inside out.
/// \throws InvalidInput like read_scan.
Scan scan_of(FileMesh& mesh, const std::filesystem::path& path);

}  // namespace crowdface
