// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/texture_search.h"

#include <string>
#include <system_error>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// The folder's entry with this name; if there is none, the first entry whose name differs only in
/// case.
std::optional<fs::path> find_entry(const fs::path& folder, const fs::path& name) {
  if (path_exists(folder / name)) return name;
  const std::string wanted = lower_case(name.string());
  std::error_code error;
  for (const fs::path& entry : list_folder(folder, &error)) {
    if (lower_case(entry.filename().string()) == wanted) return entry.filename();
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
  return is_file(folder / found) ? std::optional(found) : std::nullopt;
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
