// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/cached.h"

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"
#include "crowdface/heads/file_fingerprint.h"

namespace crowdface {

std::optional<CacheEntry> open_entry(const CacheFolder& cache, const CacheKey& key) {
  if (cache.path.empty()) return std::nullopt;
  const FileFingerprint seen(cache, cache_entry(cache, key));
  auto entry = CacheEntry::open(cache, key, seen.digest());
  if (entry) seen.remember(entry->checksum());
  return entry;
}

void warn_of_unusable_entry(const RecoverableError& error) {
  log_warning(concat(error.what(), "; it is created again"));
}

bool store(const CacheFolder& cache, const CacheKey& key, const std::vector<EntryArray>& arrays,
           std::string_view what) {
  if (cache.path.empty()) return false;
  try {
    write_entry(cache, key, arrays);
    return true;
  } catch (const RecoverableError& error) {
    log_warning(concat(what, " cannot be stored in the cache: ", error.what()));
    return false;
  }
}

}  // namespace crowdface
