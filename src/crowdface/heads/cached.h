// SPDX-License-Identifier: Apache-2.0
// Reads values from the cache, or computes and stores them. If an entry is damaged or has another
// version or other content, these functions log a warning and compute the value again. If the cache
// cannot be written, these functions only log a warning.
//
// One function lists the arrays of a value, for reading and for writing: `visit(arrays, value)`
// calls `arrays("name", member)` for each array, with an ArrayReader or an ArrayWriter.
#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/heads/cache_entry.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {

/// Opens a cache entry. With `skips_hash_of_unchanged_files`, the function does not hash an
/// unchanged entry again (see FileFingerprint).
/// \return nothing if there is no such entry or no cache.
/// \throws InvalidInput like CacheEntry::open.
std::optional<CacheEntry> open_entry(const CacheFolder& cache, const CacheKey& key);

/// Warns that a value is computed again because its entry cannot be used.
void warn_of_unusable_entry(const RecoverableError& error);

/// Reads a value from the cache.
/// \param is_sound  called with the value and the cache entry of the value: returns whether the
///                  value is valid. `is_sound` may also fill in members that the entry does not
///                  store.
/// \param value     initial value, into which the arrays are read
/// \return nothing if the entry does not exist. Also nothing, with a warning, if the entry cannot
/// be used.
template <class Value, class Visit, class IsSound>
std::optional<Value> find_cached(const CacheFolder& cache, const CacheKey& key, const Visit& visit,
                                 const IsSound& is_sound, Value value = {}) {
  try {
    const std::optional<CacheEntry> entry = open_entry(cache, key);
    if (!entry) return std::nullopt;
    const ArrayReader arrays(*entry);
    visit(arrays, value);
    entry->require(is_sound(value, *entry));
    entry->throw_if_truncated();
    return value;
  } catch (const RecoverableError& error) {
    warn_of_unusable_entry(error);
    return std::nullopt;
  }
}

/// Returns the arrays of a cached object, which refer to the object's memory. The object must live
/// until the arrays are written.
template <class Value, class Visit>
std::vector<EntryArray> arrays_of(const Value& value, const Visit& visit) {
  ArrayWriter arrays;
  visit(arrays, value);
  return std::move(arrays.arrays);
}

/// Writes a cache entry, if there is a cache.
/// \param what  replaces WHAT in the warning "WHAT cannot be stored in the cache".
/// \return whether the entry was written.
bool store(const CacheFolder& cache, const CacheKey& key, const std::vector<EntryArray>& arrays,
           std::string_view what = "data computed from the heads");

/// Returns the value from the cache. If the cache lacks the value, calls `make()` and stores the
/// result.
/// \param visit, is_sound, value  see find_cached
template <class Make, class Visit, class IsSound>
auto read_or_make(const CacheFolder& cache, const CacheKey& key, const Make& make,
                  const Visit& visit, const IsSound& is_sound, decltype(make()) value = {}) {
  auto found = find_cached(cache, key, visit, is_sound, std::move(value));
  if (found) return *std::move(found);
  auto made = make();
  store(cache, key, arrays_of(made, visit));
  return made;
}

}  // namespace crowdface
