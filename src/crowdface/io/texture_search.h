// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace crowdface {

/// Searches in `folder` for a texture, or for the buffer of a glTF file. Its path `named` comes
/// from another machine, such as "C:/anna/maps/skin.png". The search has three steps:
///
/// 1. The last parts of `named`, with as many parts as possible: "anna/maps/skin.png", then
///    "maps/skin.png", then "skin.png".
/// 2. The file name in the subfolder STEM.fbm, where STEM is `stem`.
/// 3. The file name in any subfolder, if only one subfolder has a file of this name.
///
/// Ignores the case of names, as Windows does, and whether letters are composed, as macOS does.
/// \param named  path with forward slashes; may be absolute, and may contain <UDIM>
/// \param stem   name of the mesh file without its extension
/// \return the path relative to `folder`; nothing if there is no such file.
std::optional<std::filesystem::path> search_texture(const std::filesystem::path& folder,
                                                    const std::filesystem::path& named,
                                                    const std::filesystem::path& stem);

}  // namespace crowdface
