// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace crowdface {

/// Searches for a texture, or for the buffer of a glTF file, whose path comes from another machine.
/// First tries suffixes of the path relative to `folder`, longest first; then looks in the
/// subfolder `STEM.fbm`; then takes the file of this name in any subfolder, if only one subfolder
/// has such a file. Ignores the case of names, as Windows does, and whether letters are composed,
/// as macOS does.
/// \param named  path with forward slashes; may be absolute, and may contain <UDIM>
/// \param stem   name of the mesh file without its extension
/// \return the path relative to `folder`; nothing if there is no such file.
std::optional<std::filesystem::path> search_texture(const std::filesystem::path& folder,
                                                    const std::filesystem::path& named,
                                                    const std::filesystem::path& stem);

}  // namespace crowdface
