// SPDX-License-Identifier: Apache-2.0
// Values that the cache holds: read from its entries, or made and stored. An entry that is damaged, of another version
// or of other data costs a warning and the computation; a cache that cannot be written to costs a warning.
#pragma once

#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/heads/cache_entry.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {

/// Opens an entry. If the cache trusts seen files, the bytes of an entry that nobody has written to are not hashed
/// again. \return nothing if there is none, or no cache. \throws InvalidInput as CacheEntry::open.
std::optional<CacheEntry> open_entry(const CacheFolder& cache, const CacheKey& key);

/// Says that a value is made anew because its entry could not be used.
void warn_of_entry(const RecoverableError& error);

/// \return what `read` makes of the entry; nothing if there is none or, with a warning, if `read` throws a
///         RecoverableError or somebody cut the file meanwhile.
template <class Read>
auto find_cached(const CacheFolder& cache, const CacheKey& key, const Read& read)
    -> std::optional<std::invoke_result_t<Read, const CacheEntry&>> {
  try {
    const std::optional<CacheEntry> entry = open_entry(cache, key);
    if (!entry) return std::nullopt;
    auto value = read(*entry);
    entry->require_whole();
    return value;
  } catch (const RecoverableError& error) {
    warn_of_entry(error);
    return std::nullopt;
  }
}

/// Writes an entry, if there is a cache. \param what  the warning says "WHAT cannot be kept".
/// \return whether the entry is there.
bool store(const CacheFolder& cache, const CacheKey& key, const std::vector<EntryArray>& arrays,
           std::string_view what = "what was found of the heads");

/// \param read    makes the value of an entry
/// \param make    makes the value itself
/// \param arrays  of a value that was made: what the entry is to hold
template <class Read, class Make, class Arrays>
auto cached(const CacheFolder& cache, const CacheKey& key, const Read& read, const Make& make,
            const Arrays& arrays) {
  if (auto found = find_cached(cache, key, read)) return *std::move(found);
  auto made = make();
  if (!cache.path.empty()) store(cache, key, arrays(made));  // arrays may be large copies
  return made;
}

}  // namespace crowdface
