// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/kept_lists.h"

#include <algorithm>
#include <cstdint>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// The first 48 bytes of an entry, little-endian; after them the lists' sizes, then the lists.
struct ListsHeader {
  char magic[8] = {'C', 'F', 'L', 'I', 'S', 'T', '\r', '\n'};
  std::uint64_t version = 1;
  Digest key;
  std::uint64_t count = 0;
  std::uint64_t reserved = 0;
};
static_assert(sizeof(ListsHeader) == 48);

}  // namespace

std::optional<FoundLists> find_lists(const fs::path& cache, const Digest& key, std::size_t count) {
  const fs::path path = cache_entry(cache, key, kListsEnding);
  try {
    auto entry = map_entry(path);
    if (!entry) return std::nullopt;
    const ListsHeader expected{.key = key, .count = count};
    std::string_view bytes = entry->content;
    std::vector<std::uint64_t> sizes(count);
    const std::string_view start = bytes_of(&expected, sizeof expected);
    if (!bytes.starts_with(start)) {
      throw bad_entry(path, "of another version or for other data");
    }
    bytes.remove_prefix(start.size());
    const std::size_t of_sizes = count * sizeof(std::uint64_t);
    if (bytes.size() < of_sizes) throw bad_entry(path, "of the wrong size");
    std::copy_n(bytes.data(), of_sizes, reinterpret_cast<char*>(sizes.data()));
    bytes.remove_prefix(of_sizes);
    FoundLists found{std::move(entry->file), {}};
    for (const std::uint64_t size : sizes) {
      if (size > bytes.size()) throw bad_entry(path, "of the wrong size");
      found.lists.push_back(bytes.substr(0, size));
      bytes.remove_prefix(size);
    }
    if (!bytes.empty()) throw bad_entry(path, "of the wrong size");
    return found;
  } catch (const RecoverableError& error) {
    log_warning(concat(error.what(), "; it is made anew"));
    return std::nullopt;
  }
}

bool keep_lists(const fs::path& cache, const Digest& key,
                const std::vector<std::string_view>& lists) {
  const ListsHeader header{.key = key, .count = lists.size()};
  std::vector<std::uint64_t> sizes;
  for (const std::string_view list : lists) sizes.push_back(list.size());
  std::vector<std::string_view> pieces = {bytes_of(&header, sizeof header),
                                          bytes_of(std::span<const std::uint64_t>(sizes))};
  pieces.insert(pieces.end(), lists.begin(), lists.end());
  try {
    write_entry(cache_entry(cache, key, kListsEnding), std::move(pieces));
    return true;
  } catch (const RecoverableError& error) {
    log_warning(concat("what was found of the heads cannot be kept: ", error.what()));
    return false;
  }
}

void warn_of_damage(const fs::path& cache, const Digest& key) {
  const fs::path path = cache_entry(cache, key, kListsEnding);
  const InvalidInput error = bad_entry(path, "damaged (it holds numbers that no head has)");
  log_warning(concat(error.what(), "; it is made anew"));
}

}  // namespace crowdface
