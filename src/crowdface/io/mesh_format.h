// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace crowdface {

/// A format that faces are written in.
enum class MeshFormat {
  kObj,     ///< the target's own file with other positions
  kPly,     ///< binary
  kGlb,     ///< binary glTF 2.0
  kPoints,  ///< positions alone, .npy
  kUsd,     ///< a layer of USD as text, .usda
};

/// All of them, in the order in which they are named.
const std::vector<MeshFormat>& all_mesh_formats();
/// The word of the config: "points".
std::string_view name_of(MeshFormat format);
/// ".npy".
std::string_view extension_of(MeshFormat format);
/// The format that a file's name asks for by its ending, in any case; nothing if it is another.
std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& file);

}  // namespace crowdface
