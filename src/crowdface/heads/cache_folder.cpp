// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cache_folder.h"

#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/hash.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/cache_entry.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// Whether a file is named like an entry (see cache_entry).
bool has_name_of_entry(const fs::path& path) {
  constexpr std::size_t kDigits = 32;
  const std::string stem = path.stem().string();
  return path.extension().string() == kCacheExtension && stem.size() > kDigits &&
         parse_digest(std::string_view(stem).substr(stem.size() - kDigits));
}

}  // namespace

fs::path cache_directory() {
  const auto from = [](const char* variable) -> std::string {
    const char* value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): read at start only
    return value == nullptr ? std::string() : std::string(value);
  };
  if (const std::string xdg = from("XDG_CACHE_HOME"); !xdg.empty())
    return fs::path(xdg) / "crowdface";
  if (const std::string home = from("HOME"); !home.empty()) {
    return fs::path(home) / ".cache" / "crowdface";
  }
  std::error_code error;
  // temp_directory_path sets `error` if the folder does not exist.
  const fs::path temporary = fs::temp_directory_path(error);
  return (error ? fs::path("/tmp") : temporary) / "crowdface-cache";
}

CacheContents list_cache(const fs::path& cache) {
  std::error_code error, ignored;
  CacheContents contents;
  contents.entries = list_files(
      cache, [](const fs::path& path) { return has_name_of_entry(path) && path_exists(path); },
      &error);
  if (error && error != std::errc::no_such_file_or_directory) {
    throw MissingInput(concat(cache.string(), ": cannot be read as a folder: ", error.message()));
  }
  for (const fs::path& entry : contents.entries) {
    for (const fs::path& file :
         is_directory(entry) ? list_files(entry, is_file) : std::vector{entry}) {
      contents.bytes += fs::file_size(file, ignored);
    }
    const std::string name = entry.filename().string();
    contents.prepared_head_count += name.starts_with(kPreparedKind) ? 1U : 0U;
    contents.loaded_head_count += name.starts_with(kReadKind) ? 1U : 0U;
  }
  return contents;
}

std::size_t clear_cache(const fs::path& cache) {
  std::size_t removed = remove_temporary_files(cache);
  for (const fs::path& entry : list_cache(cache).entries) {
    std::error_code error;
    if (fs::remove_all(entry, error) > 0) ++removed;
    if (error) throw IoError(concat(entry.string(), ": cannot be removed: ", error.message()));
  }
  return removed;
}

}  // namespace crowdface
