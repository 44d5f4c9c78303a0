// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "crowdface/wrap/scan.h"

namespace crowdface {

/// Reads the geometry of a scan, in any format of `read_mesh`. Vertices that stand in one place are welded; their numbers
/// are those of the file (of an STL file: of its corners in order; of a glTF file: of its primitives one after the other).
/// \throws MissingInput; InvalidInput naming file, what was expected and what was found.
Scan read_scan(const std::filesystem::path& path);

}  // namespace crowdface
