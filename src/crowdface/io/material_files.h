// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
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
  std::filesystem::path source;       ///< path of the file to copy
  std::filesystem::path destination;  ///< path of the copy, relative to the meshes' folder
  bool is_material_file = false;      ///< true: a material file; false: a texture
  /// Kind of the texture. Nothing if the file is a material file, if material files use the texture
  /// for several kinds, or if an unknown statement names the texture.
  std::optional<TextureKind> kind = {};
};

/// The colour, opacity and maps of a material, as its material file describes them.
struct SurfaceMaterial {
  std::string name;
  std::optional<std::array<float, 3>> colour = {};  ///< `Kd`: linear RGB, each from 0 to 1
  float opacity = 1;  ///< opacity: the number of the statement `d`, or 1 − the number of `Tr`
  std::filesystem::path colour_map = {};  ///< path of the texture of `map_Kd`; empty: there is none
  std::filesystem::path opacity_map = {};  ///< path of the texture of `map_d`; empty: there is none
};

/// Result of `find_material_files`.
struct MaterialFiles {
  std::vector<MaterialFile> files;  ///< the files to copy, one entry per destination
  /// The materials, in the order of the material files. `files` contains each of their maps.
  std::vector<SurfaceMaterial> surface_materials;
  /// One message for each problem: a file is missing, cannot be read or is not copied; the material
  /// files contain too many names.
  std::vector<std::string> warnings;
  /// Whether a material file was found at another path than the mesh names. In this case the
  /// `mtllib` line of a written mesh must name the path where the file was found.
  bool has_library_at_other_path = false;
};

/// Name of the folder, beside the meshes, that contains only files made by this program.
inline constexpr std::string_view kBlendedFolder = "blended";

/// A line of a material file.
struct MaterialLine {
  std::string_view text;  ///< the whole line
  /// The first word, and the text after this word; both are empty if the line has fewer than two
  /// words. Known keywords have the case of the format's description: "map_Kd" for "MAP_KD".
  std::string_view keyword = {}, arguments = {};
  /// name of the material to which the line belongs; empty before the first `newmtl`
  std::string_view material = {};
};
/// Splits the text of a material file, as `read_material_text` returns it.
std::vector<MaterialLine> material_lines(std::string_view text);
/// Reads a material file and converts it with `plain_text`.
std::string read_material_text(const std::filesystem::path& file);
/// Whether a statement with this first word names a texture.
bool is_texture_statement(std::string_view word);

/// Finds the material files that a mesh names, and the textures that these files name. A name with
/// the placeholder `<UDIM>` stands for all existing tiles. Warns about files that are missing or
/// unreadable, and if there are more names than `input_limits().textures`. Also warns about files
/// that crowdface does not copy: files outside the mesh's folder that are not images, and files
/// whose names crowdface uses for its own files (mesh files, and everything in the folders
/// `topology` and `blended`). An image outside the mesh's folder is copied under its file name.
/// \param mesh  path of the OBJ file.
/// \param libraries  arguments of the `mtllib` lines; each may name several files.
MaterialFiles find_material_files(const std::filesystem::path& mesh,
                                  const std::vector<std::string>& libraries);

/// Returns one material per name: the first material of this name in `files`, or a default material
/// if there is none.
std::vector<SurfaceMaterial> surface_materials_of(const std::vector<std::string>& names,
                                                  const MaterialFiles& files);

/// The textures that the materials of a mesh refer to.
struct NamedTextures {
  /// Texture paths, relative to the mesh's folder, by kind of texture and name of material. A path
  /// may contain <UDIM> in place of a tile number.
  std::map<TextureKind, std::map<std::string, std::filesystem::path>> paths_by_kind;
  /// Name of the material if the libraries define exactly one; otherwise empty. Polygons without a
  /// material use this material.
  std::string single_material;
  /// Warnings about material files that are missing or broken, and about paths that lead nowhere.
  std::vector<std::string> warnings;
};

/// Finds, for each material and each kind of texture, the first texture that the material names.
/// Does not check whether the files exist.
NamedTextures find_textures(const std::filesystem::path& mesh,
                            const std::vector<std::string>& libraries);

}  // namespace crowdface
