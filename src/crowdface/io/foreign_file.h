// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

namespace crowdface {

/// Refuses bytes that are plainly something else than a mesh: a web page that a browser saved, an archive, a picture,
/// the scene of a modelling program.
/// \throws InvalidInput that says what it is and how to come by the mesh.
void refuse_foreign_file(std::string_view bytes, const std::filesystem::path& path);

}  // namespace crowdface
