// SPDX-License-Identifier: Apache-2.0
// Values that the cache holds: read from its entries, or made and stored. An entry that is damaged, of another version
// or of other data costs a warning and the computation; a cache that cannot be written to costs a warning.
//
// One function tells which arrays a value is kept in, for reading and writing: `visit(arrays, value)` calls
// `arrays("name", member)` for each, with an ArrayReader or an ArrayWriter.
#pragma once

#include <optional>
#include <string_view>
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

/// \param is_sound  of a value and its entry: whether the value is such as could have been stored. It may complete the
///                  value.
/// \param value     into which the arrays are read
/// \return nothing if there is no entry or, with a warning, if it cannot be used.
template <class Value, class Visit, class IsSound>
std::optional<Value> find_cached(const CacheFolder& cache, const CacheKey& key, const Visit& visit,
                                 const IsSound& is_sound, Value value = {}) {
  try {
    const std::optional<CacheEntry> entry = open_entry(cache, key);
    if (!entry) return std::nullopt;
    const ArrayReader arrays(*entry);
    visit(arrays, value);
    entry->require(is_sound(value, *entry));
    entry->require_whole();
    return value;
  } catch (const RecoverableError& error) {
    warn_of_entry(error);
    return std::nullopt;
  }
}

/// The arrays of a value, which must live until they are written.
template <class Value, class Visit>
std::vector<EntryArray> arrays_of(const Value& value, const Visit& visit) {
  ArrayWriter arrays;
  visit(arrays, value);
  return std::move(arrays.arrays);
}

/// Writes an entry, if there is a cache. \param what  the warning says "WHAT cannot be kept".
/// \return whether the entry is there.
bool store(const CacheFolder& cache, const CacheKey& key, const std::vector<EntryArray>& arrays,
           std::string_view what = "what was found of the heads");

/// What `make()` returns, from the cache if it is there.
template <class Make, class Visit, class IsSound>
auto cached(const CacheFolder& cache, const CacheKey& key, const Make& make, const Visit& visit,
            const IsSound& is_sound, decltype(make()) value = {}) {
  auto found = find_cached(cache, key, visit, is_sound, std::move(value));
  if (found) return *std::move(found);
  auto made = make();
  store(cache, key, arrays_of(made, visit));
  return made;
}

}  // namespace crowdface
