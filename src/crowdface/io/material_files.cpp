// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/material_files.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/file_descriptor.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"
#include "crowdface/io/image.h"
#include "crowdface/io/legacy_text.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/io/texture_search.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBlanks = " \t\r";
constexpr std::string_view kTexture = "texture";  // in warnings
constexpr std::uintmax_t kLargestMaterialFile = 16U << 20U;

/// Whether a path contains a NUL character. The operating system would truncate the path there.
bool holds_nul(const fs::path& path) {
  return path.native().find('\0') != std::string::npos;
}

/// Whether a relative path stays inside the folder from which it starts.
bool stays_inside(const fs::path& relative) {
  if (holds_nul(relative)) return false;
  const fs::path normal = relative.lexically_normal();
  return !normal.empty() && normal.is_relative() && *normal.begin() != "..";
}

std::string with_forward_slashes(std::string_view text) {
  std::string path(text);
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

/// Whether a file with this name in the folder of the meshes could be one of crowdface's own output
/// files: a mesh, or an array of the topology that all meshes share.
bool is_own_output_name(const fs::path& relative) {
  const fs::path normal = relative.lexically_normal();
  const bool is_mesh = std::ranges::any_of(
      normal, [&](const fs::path& part) { return mesh_format_of(part).has_value(); });
  const std::string folder = lower_case(normal.begin()->string());
  return is_mesh || folder == "topology" || folder == kBlendedFolder;
}

/// The reason why a file with this name is not copied; empty if it is copied.
std::string_view reason_not_copied(const fs::path& relative) {
  if (!stays_inside(relative)) return "has a path that leads out of its folder";
  if (is_own_output_name(relative)) return "has a name that belongs to crowdface's own files";
  // The ledger and the report of a run are UTF-8, so they cannot contain other names.
  if (!is_utf8(relative.native())) return "has a name that is not UTF-8";
  return {};
}

/// All suffixes of a statement's arguments that begin at one of the last 32 words, longest first.
/// One of the suffixes is the file name: the file name comes after the options and may contain
/// spaces.
std::vector<std::string_view> suffixes_starting_at_words(std::string_view text) {
  constexpr std::size_t kMaxSuffixes = 32;
  std::vector<std::string_view> suffixes;
  for (std::size_t end = text.size(); end > 0 && suffixes.size() < kMaxSuffixes;) {
    const std::size_t begin = text.find_last_of(kBlanks, end - 1) + 1;  // npos + 1 is 0
    suffixes.push_back(text.substr(begin));
    end = begin == 0 ? 0 : text.find_last_not_of(kBlanks, begin - 1) + 1;
  }
  std::ranges::reverse(suffixes);
  return suffixes;
}

/// The numbers with which a text begins, clamped to [0, 1].
std::vector<float> leading_fractions(std::string_view text) {
  std::vector<float> numbers;
  for (const std::string& word : words_of(text)) {
    const auto number = parse_double(word);
    if (!number) break;
    numbers.push_back(std::clamp(static_cast<float>(*number), 0.0F, 1.0F));
  }
  return numbers;
}

/// If a line of a material file is a statement `Kd`, `d` or `Tr`, sets the material's colour or
/// opacity from this line; otherwise does nothing.
void set_colour(const MaterialLine& line, SurfaceMaterial& material) {
  if (line.keyword != "Kd" && line.keyword != "d" && line.keyword != "Tr") return;
  const std::vector<float> numbers = leading_fractions(line.arguments);
  if (line.keyword == "Kd") {
    if (numbers.size() == 3) material.colour = {numbers[0], numbers[1], numbers[2]};
  } else if (numbers.size() == 1) {
    material.opacity = line.keyword == "d" ? numbers[0] : 1 - numbers[0];
  }
}

/// Reads material files and collects the files that they name.
class Collector {
 public:
  explicit Collector(const fs::path& mesh) : mesh_(mesh), folder_(mesh.parent_path()) {}

  void add_library(const std::string& argument) {
    throw_if_interrupted();
    // The argument of `mtllib` may be one file name with spaces, or a list of file names. It is one
    // name if a file with this name exists.
    if (exists(argument)) return take_library(argument);
    if (const auto beside = library_beside(argument)) return take_renamed(*beside);
    for (const std::string& name : words_of(argument)) {
      const auto beside = exists(name) ? std::nullopt : library_beside(name);
      beside ? take_renamed(*beside) : take_library(name);
    }
  }

  MaterialFiles take_files() {
    for (const auto& [relative, texture] : texture_uses_) {
      if (texture.kinds.size() > 1) continue;
      for (const std::size_t file : texture.files) files_.files[file].kind = *texture.kinds.begin();
    }
    return std::move(files_);
  }
  NamedTextures take_textures() {
    NamedTextures named{std::move(of_kind_), {}, {}};
    std::set<std::string_view> materials;
    for (const SurfaceMaterial& material : files_.surface_materials)
      materials.insert(material.name);
    if (materials.size() == 1) named.single_material = *materials.begin();
    for (auto& [kind, of_material] : named.paths_by_kind) {
      const auto only = of_material.find(named.single_material);
      if (only != of_material.end()) of_material.emplace("", only->second);
    }
    named.warnings = take_files().warnings;
    return named;
  }

 private:
  /// A set of distinct file names (of material files or of textures) with a maximum size.
  struct NameSet {
    std::set<fs::path> known;
    bool full = false;
  };
  enum class NameStatus { kNew, kKnown, kTooMany };

  /// Adds a file name to `names`. If `names` is full, warns once and does not add the name.
  /// \param what   "texture" or "material file", for the warning
  /// \param where  the file that contains the name
  NameStatus add_name(const fs::path& relative, std::string_view what, const fs::path& where,
                      NameSet& names) {
    if (names.known.contains(relative)) return NameStatus::kKnown;
    if (names.known.size() < input_limits().textures) {
      names.known.insert(relative);
      return NameStatus::kNew;
    }
    if (!names.full) {
      files_.warnings.push_back(concat(where.string(), ": names more than ",
                                       input_limits().textures, ' ', what, "s, from ",
                                       quoted(relative.string()),
                                       " on; these are neither copied nor shown "
                                       "(--limit textures=NUMBER allows more)"));
    }
    names.full = true;
    return NameStatus::kTooMany;
  }

  bool exists(const fs::path& relative) const {
    return !holds_nul(relative) && is_file(folder_ / relative);
  }
  bool exists_as_texture(const fs::path& relative) const {
    return exists(relative) || exists(udim_tile_path(relative, kFirstTile));
  }

  /// Whether the file lies outside the mesh's folder, by its path or because of a link.
  bool is_outside(const fs::path& relative) const {
    return !stays_inside(relative) || !is_inside_folder(folder_ / relative, folder_);
  }

  /// Files outside the mesh's folder are copied only if they are images. Otherwise a downloaded
  /// material file could name a private file, and the crowd would contain its copy.
  bool is_image(const fs::path& relative) const {
    try {
      read_image_size(folder_ / relative, {.allows_jpeg = true});
      return true;
    } catch (const InvalidInput&) {
      return false;
    }
  }

  static fs::path destination_of(const fs::path& relative) {
    return (stays_inside(relative) ? relative : relative.filename()).lexically_normal();
  }

  bool take_file(const fs::path& relative, std::string_view what) {
    const auto refuse = [&](std::string_view why) {
      files_.warnings.push_back(concat(what, " ", quoted(relative.string()), " ", why));
      return false;
    };
    const fs::path destination = destination_of(relative);
    if (const std::string_view objection = reason_not_copied(destination); !objection.empty()) {
      return refuse(concat(objection, " and is not copied"));
    }
    if (!exists(relative)) {
      return refuse("is missing; OBJ files still name it, but renders omit it");
    }
    if (::access((folder_ / relative).c_str(), R_OK) != 0) {
      throw_if_system_error(folder_ / relative, {errno, std::generic_category()});
      return refuse("cannot be read and is not copied");
    }
    if (is_outside(relative) && (what != kTexture || !is_image(relative))) {
      return refuse("lies outside the head's folder and is not copied");
    }
    const fs::path source = (folder_ / relative).lexically_normal();
    const auto [copied, is_new] = destinations_.emplace(destination, source);
    if (copied->second != source)
      return refuse("has the name of another texture and is not copied");
    if (is_new) files_.files.push_back({source, destination});
    return is_new;
  }

  /// Finds the file for a path that has backslashes, differs in case, or comes from another
  /// machine. Tries the path with forward slashes, then the path's file name in the mesh's folder.
  std::optional<fs::path> library_beside(std::string_view text) {
    for (const std::string& name : possible_names(text)) {
      const fs::path path = with_forward_slashes(name);
      for (const fs::path& relative : {path, path.filename()}) {
        if (stays_inside(relative) && exists(relative)) return relative;
      }
      if (holds_nul(path) || ++searches_ > kMaxSearches) continue;
      if (auto found = search_texture(folder_, path, mesh_.stem())) return found;
    }
    return std::nullopt;
  }
  void take_renamed(const fs::path& library) {
    files_.has_library_at_other_path = true;
    take_library(library);
  }

  void take_library(const fs::path& name) {
    if (add_name(name, "material file", mesh_, libraries_) != NameStatus::kNew) return;
    if (!take_file(name, "material file")) return;
    files_.files.back().is_material_file = true;
    const fs::path file = folder_ / name;
    std::error_code error;
    const bool is_too_large = fs::file_size(file, error) > kLargestMaterialFile;
    throw_if_system_error(file, error);
    if (is_too_large || error) return;
    textures_of_.clear();
    const std::string text = read_material_text(file);
    if (text.find('\0') != text.npos) {
      files_.warnings.push_back(concat("material file ", quoted(name.string()),
                                       " is not text in UTF-8, so its textures are not used: save "
                                       "it as UTF-8"));
      return;
    }
    for (const MaterialLine& line : material_lines(text)) {
      throw_if_interrupted();
      if (line.keyword == "newmtl")
        files_.surface_materials.push_back({std::string(line.arguments)});
      SurfaceMaterial* const material =
          files_.surface_materials.empty() ? nullptr : &files_.surface_materials.back();
      if (material != nullptr) set_colour(line, *material);
      if (!is_texture_statement(line.keyword)) continue;
      const fs::path relative = texture_of(line.arguments, name.parent_path());
      const NameStatus status = add_name(relative, kTexture, file, textures_);
      if (status != NameStatus::kTooMany) use_texture(relative, status, line);
      if (material == nullptr) continue;
      if (line.keyword == "map_Kd") material->colour_map = copied_file(relative);
      if (line.keyword == "map_d") material->opacity_map = copied_file(relative);
    }
  }

  void use_texture(const fs::path& relative, NameStatus status, const MaterialLine& line) {
    const std::optional<TextureKind> kind = texture_kind_of(line.keyword);
    if (kind && (stays_inside(relative) || exists_as_texture(relative))) {
      of_kind_[*kind].emplace(line.material, (folder_ / relative).lexically_normal());
    }
    texture_uses_[relative].kinds.insert(kind);
    if (status == NameStatus::kNew) take_texture(relative);
  }

  /// Returns the source path of a texture that take_file has accepted; an empty path for any other
  /// texture.
  fs::path copied_file(const fs::path& relative) const {
    fs::path source = (folder_ / relative).lexically_normal();
    const auto copied = destinations_.find(destination_of(relative));
    return copied != destinations_.end() && copied->second == source ? source : fs::path();
  }

  /// Returns the longest suffix of the statement that names an existing file or (with <UDIM>) an
  /// existing first tile. If no suffix names a file, returns the last word if the statement has
  /// options, and otherwise the whole text.
  fs::path texture_of(std::string_view rest, const fs::path& folder) {
    const auto [known, is_new] = textures_of_.try_emplace(std::string(rest));
    if (!is_new) return known->second;
    const std::vector<std::string_view> suffixes = suffixes_starting_at_words(rest);
    const bool has_options = rest.starts_with('-');
    known->second = folder / with_forward_slashes(has_options ? suffixes.back() : rest);
    if (textures_.full) return known->second;
    for (const std::string_view suffix : suffixes) {
      fs::path relative = folder / with_forward_slashes(suffix);
      if (!exists_as_texture(relative)) continue;
      return known->second = std::move(relative);
    }
    // The path may come from another machine or have another encoding. First look for the file name
    // in the folder, then search the subfolders.
    for (const std::string_view suffix : suffixes) {
      for (const std::string& name : possible_names(suffix)) {
        const fs::path beside = folder / fs::path(with_forward_slashes(name)).filename();
        if (beside.filename().empty() || beside.filename() == "." || beside.filename() == "..")
          continue;
        if (!exists_as_texture(beside)) continue;
        return known->second = beside;
      }
    }
    for (const std::string& name : possible_names(has_options ? suffixes.back() : rest)) {
      if (name.find('\0') != name.npos || ++searches_ > kMaxSearches) break;
      const fs::path path = with_forward_slashes(name);
      if (const auto found = search_texture(folder_ / folder, path, mesh_.stem()))
        return known->second = folder / *found;
      if (folder.empty()) continue;
      if (const auto found = search_texture(folder_, path, mesh_.stem()))
        return known->second = *found;
    }
    return known->second;
  }

  /// All names that the text may mean: the text decoded from each possible encoding, the unchanged
  /// text, the text without a comment at its end and without quotation marks, and the text without
  /// percent escapes.
  static std::vector<std::string> possible_names(std::string_view text) {
    std::vector<std::string> names = legacy_decodings(text);
    names.emplace_back(text);
    std::string_view bare = text.substr(0, text.find(" #"));
    bare = bare.substr(0, bare.find_last_not_of(kBlanks) + 1);
    if (bare.size() > 2 && bare.front() == '"' && bare.back() == '"')
      bare = bare.substr(1, bare.size() - 2);
    if (bare != text && !bare.empty()) names.emplace_back(bare);
    const auto decoded = percent_decoded(bare);
    if (decoded && *decoded != bare) names.push_back(*decoded);
    return names;
  }

  void take_texture(const fs::path& relative) {
    std::vector<fs::path> tiles;
    if (!holds_nul(relative)) tiles = find_tiles(folder_ / relative);
    const std::size_t before = files_.files.size();
    for (const fs::path& tile : tiles) {
      take_file(relative.parent_path() / tile.filename(), kTexture);
    }
    if (tiles.empty()) take_file(relative, kTexture);
    for (std::size_t i = before; i < files_.files.size(); ++i) {
      texture_uses_[relative].files.push_back(i);
    }
  }

  fs::path mesh_, folder_;
  NameSet libraries_, textures_;
  /// largest number of searches, each of which lists the folder and its subfolders
  static constexpr int kMaxSearches = 64;
  int searches_ = 0;
  /// Maps the destination of each file to copy to its source.
  std::map<fs::path, fs::path> destinations_;
  /// Maps the text of a statement to its texture path. Valid only within one material file.
  std::map<std::string, fs::path> textures_of_;
  MaterialFiles files_;
  /// How the material files use one texture.
  struct TextureUses {
    /// The kinds of the statements that name the texture; an unknown statement adds std::nullopt.
    std::set<std::optional<TextureKind>> kinds;
    std::vector<std::size_t> files;  ///< indices of the texture's files (tiles) in `files_.files`
  };
  std::map<TextureKind, std::map<std::string, fs::path>> of_kind_;
  std::map<fs::path, TextureUses> texture_uses_;
};

/// A known keyword in its usual case, such as `map_Kd` for `map_kd`; other words unchanged.
std::string_view usual_spelling(std::string_view word) {
  std::vector<std::string_view> known = {"newmtl", "Kd", "d", "Tr", "map_d", "bump"};
  for (const TextureStatement& statement : kTextureStatements) known.push_back(statement.word);
  const std::string wanted = lower_case(word);
  for (const std::string_view keyword : known) {
    if (lower_case(keyword) == wanted) return keyword;
  }
  return word;
}

Collector collect(const fs::path& mesh, const std::vector<std::string>& libraries) {
  Collector collector(mesh);
  for (const std::string& library : libraries) collector.add_library(library);
  return collector;
}

}  // namespace

std::vector<MaterialLine> material_lines(std::string_view text) {
  std::vector<MaterialLine> lines;
  std::string_view material;
  for (const std::string_view whole : split_lines(text)) {
    MaterialLine& line = lines.emplace_back(MaterialLine{whole});
    std::string_view words = whole.substr(0, whole.find_last_not_of(kBlanks) + 1);
    words = words.substr(std::min(words.find_first_not_of(kBlanks), words.size()));
    const std::size_t blank = words.find_first_of(kBlanks);
    if (blank != words.npos) {
      line.keyword = usual_spelling(words.substr(0, blank));
      line.arguments = words.substr(words.find_first_not_of(kBlanks, blank));
    }
    if (line.keyword == "newmtl") material = line.arguments;
    line.material = material;
  }
  return lines;
}

std::string read_material_text(const fs::path& file) {
  return plain_text(read_file(file));
}

bool is_texture_statement(std::string_view word) {
  return word.starts_with("map_") || word == "bump" || word == "disp" || word == "decal" ||
         word == "refl" || word == "norm";
}

std::vector<SurfaceMaterial> surface_materials_of(const std::vector<std::string>& names,
                                                  const MaterialFiles& files) {
  std::vector<SurfaceMaterial> materials;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(files.surface_materials, name, &SurfaceMaterial::name);
    materials.push_back(found != files.surface_materials.end() ? *found : SurfaceMaterial{name});
  }
  return materials;
}

MaterialFiles find_material_files(const fs::path& mesh, const std::vector<std::string>& libraries) {
  return collect(mesh, libraries).take_files();
}

NamedTextures find_textures(const fs::path& mesh, const std::vector<std::string>& libraries) {
  return collect(mesh, libraries).take_textures();
}

}  // namespace crowdface
