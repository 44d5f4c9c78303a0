// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/texture_search.h"

#include <string>
#include <system_error>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"
#include "crowdface/io/decomposed_text.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// The file of a texture; if the path contains <UDIM>, the file of the first tile.
fs::path first_file(const fs::path& path) {
  return udim_tile_path(path, kFirstTile);
}

/// Finds the last occurrence of the number kFirstTile in a file name, and puts <UDIM> in its place.
fs::path with_tile_word(std::string name) {
  const std::string number = std::to_string(kFirstTile);
  const std::size_t at = name.rfind(number);
  if (at != name.npos) name.replace(at, number.size(), kTileWord);
  return name;
}

/// Names that differ only in case, or in the normal form of Unicode, have the same key.
std::string key_of(const fs::path& name) {
  return lower_case(decomposed(name.string()));
}

/// The folder's entry with this name. If there is none, the first entry whose name differs from
/// `name` only in case or in the normal form of Unicode (see key_of).
/// \param name  may contain <UDIM>; so does the result.
std::optional<fs::path> find_entry(const fs::path& folder, const fs::path& name) {
  const fs::path file = first_file(name);
  if (path_exists(folder / file)) return name;
  const std::string wanted = key_of(file);
  std::error_code error;
  for (const fs::path& entry : list_folder(folder, &error)) {
    if (key_of(entry.filename()) != wanted) continue;
    return file == name ? entry.filename() : with_tile_word(entry.filename().string());
  }
  return std::nullopt;
}

std::optional<fs::path> find_below(const fs::path& folder, const std::vector<fs::path>& parts) {
  fs::path found;
  for (const fs::path& part : parts) {
    const auto entry = find_entry(folder / found, part);
    if (!entry) return std::nullopt;
    found /= *entry;
  }
  return is_file(folder / first_file(found)) ? std::optional(found) : std::nullopt;
}

}  // namespace

std::optional<fs::path> search_texture(const fs::path& folder, const fs::path& named,
                                       const fs::path& stem) {
  constexpr std::ptrdiff_t kMaxParts = 6;
  std::vector<fs::path> parts;
  for (const fs::path& part : named.relative_path()) {
    if (part == "..") {
      parts.clear();
    } else if (part != ".") {
      parts.push_back(part);
    }
  }
  if (parts.empty() || parts.back().empty()) return std::nullopt;
  if (std::ssize(parts) > kMaxParts) parts.erase(parts.begin(), parts.end() - kMaxParts);
  const fs::path name = parts.back();
  for (; !parts.empty(); parts.erase(parts.begin())) {
    if (auto found = find_below(folder, parts)) return found;
  }
  if (auto found = find_below(folder, {stem.string() + ".fbm", name})) return found;
  constexpr std::size_t kMaxSubfolders = 64;
  std::optional<fs::path> only;
  std::size_t subfolders = 0;
  std::error_code error;
  for (const fs::path& entry : list_folder(folder, &error)) {
    if (!is_folder(entry)) continue;
    if (++subfolders > kMaxSubfolders) return std::nullopt;
    auto found = find_below(folder, {entry.filename(), name});
    if (found && only) return std::nullopt;
    if (found) only = std::move(found);
  }
  return only;
}

}  // namespace crowdface
