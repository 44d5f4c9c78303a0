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

/// A material file or texture to copy beside a mesh, so that the mesh's `mtllib` and its textures
/// can be found.
struct MaterialFile {
  std::filesystem::path source;       ///< source path
  std::filesystem::path destination;  ///< destination path, relative to the meshes' folder
  bool is_library = false;            ///< a material file, not a texture
  /// Kind of the texture; nothing if statements of several kinds or an unknown statement name it.
  std::optional<TextureKind> kind = {};
};

struct MaterialFiles {
  std::vector<MaterialFile> files;  ///< one per destination
  /// Textures whose source file is missing, or whose copy may be missing.
  std::vector<std::string> warnings;
  /// Whether a material file was found beside the mesh and not at its path: a written mesh must
  /// then name the found file in its `mtllib` line.
  bool has_renamed_library = false;
};

/// Folder beside the meshes that contains only files made by this program.
inline constexpr std::string_view kBlendedFolder = "blended";

/// The first word of a line in a material file, and the rest of the line; nothing if the line has
/// fewer than two words.
struct MaterialStatement {
  std::string_view word, rest;
};
MaterialStatement material_statement(std::string_view line);
/// Whether a statement with this first word names a texture.
bool is_texture_statement(std::string_view word);
/// All suffixes of a text that begin at a word, longest first: a file name may contain spaces, and
/// follows the options. Limited to the last 32 words.
std::vector<std::string_view> word_suffixes(std::string_view text);

/// Finds the material files that a mesh names, and the textures that these files name; for names
/// with <UDIM> all existing tiles. Problems become warnings, not errors: files that are missing or
/// unreadable, paths that lead out of the mesh's folder (which are not followed), names that a mesh
/// may have (see `mesh_format_of`), names in `topology` or `blended`, and more names than
/// `input_limits().textures`.
/// \param mesh  path of the OBJ file.
/// \param libraries  arguments of the `mtllib` lines; each may name several files.
MaterialFiles find_material_files(const std::filesystem::path& mesh,
                                  const std::vector<std::string>& libraries);

/// The textures that the materials of a mesh name.
struct NamedTextures {
  /// Texture paths by kind and material, relative to the mesh's folder; may contain <UDIM> in place
  /// of a tile number.
  std::map<TextureKind, std::map<std::string, std::filesystem::path>> paths_by_kind;
  /// The only material that the libraries define, or empty; faces without a material use it.
  std::string only_material;
  /// Problems with libraries and paths, as in `MaterialFiles`.
  std::vector<std::string> warnings;
};

/// The first texture of each kind that each material names. Does not check whether the files exist.
NamedTextures find_textures(const std::filesystem::path& mesh,
                            const std::vector<std::string>& libraries);

}  // namespace crowdface
