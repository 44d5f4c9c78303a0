// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/io/texture_kind.h"

namespace crowdface {

/// One file to put beside a mesh so that its `mtllib` and the textures named there are found.
struct MaterialFile {
  std::filesystem::path from;      ///< where it is
  std::filesystem::path relative;  ///< where it goes, below the meshes' folder
  bool is_library = false;         ///< not a texture
  std::optional<TextureKind> kind =
      {};  ///< the one that a texture is named as; none: several, others
};

struct MaterialFiles {
  std::vector<MaterialFile> files;    ///< each destination once
  std::vector<std::string> warnings;  ///< about names that have no file here or may have none there
};

/// Beside meshes: what lies in this folder is ours alone.
inline constexpr std::string_view kBlendedFolder = "blended";

/// The first word of a material file's line and all that stands behind it; nothing if it has no two words.
struct MaterialStatement {
  std::string_view word, rest;
};
MaterialStatement material_statement(std::string_view line);
/// Whether a statement of this word names a texture.
bool is_texture_statement(std::string_view word);

/// The material files that a mesh names and the textures that those name, with <UDIM> in their names
/// all tiles that are there. A file that is missing or cannot be read is a warning, not an error; so
/// is a path that leads out of the mesh's folder, which is not followed, a name that a mesh may have
/// (see mesh_format_of) or that lies in `topology` or `blended`, and more names than
/// input_limits().textures.
/// \param mesh       path of the OBJ file.
/// \param libraries  the arguments of its `mtllib` lines; each may name several files.
MaterialFiles find_material_files(const std::filesystem::path& mesh,
                                  const std::vector<std::string>& libraries);

/// The textures that a mesh's materials name.
struct NamedTextures {
  /// By kind and material, below the mesh's folder; may hold <UDIM>, which stands for a tile's number.
  std::map<TextureKind, std::map<std::string, std::filesystem::path>> of_kind;
  std::vector<std::string> warnings;  ///< about libraries and paths as above
};

/// The first of each kind that a material names; whether there is such a file is not asked.
NamedTextures find_textures(const std::filesystem::path& mesh,
                            const std::vector<std::string>& libraries);

}  // namespace crowdface
