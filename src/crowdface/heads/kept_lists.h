// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "crowdface/core/hash.h"
#include "crowdface/heads/cache_folder.h"

namespace crowdface {

/// An entry's lists as bytes, which stand one after the other.
struct FoundLists {
  std::shared_ptr<const MappedFile> file;
  std::vector<std::string_view> lists;
};

/// \return nothing if there is no entry of so many lists, or, with a warning, if it is damaged.
std::optional<FoundLists> find_lists(const std::filesystem::path& cache, const Digest& key,
                                     std::size_t count);
/// \return whether they could be kept: a cache that cannot be written costs a warning.
bool keep_lists(const std::filesystem::path& cache, const Digest& key,
                const std::vector<std::string_view>& lists);
/// That an entry's lists are not such as could have been kept.
void warn_of_damage(const std::filesystem::path& cache, const Digest& key);

namespace detail {

/// \return whether the bytes are a whole number of these.
template <class T>
bool take_list(std::string_view bytes, std::vector<T>& list) {
  if (bytes.size() % sizeof(T) != 0) return false;
  list.resize(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(list.data(), bytes.data(), bytes.size());
  return true;
}

}  // namespace detail

/// What `make()` returns, lists of numbers; kept, so that with the same key it is made once.
/// \param cache     the folder; empty: nothing is kept.
/// \param key       of all that the lists depend on.
/// \param is_sound  of lists from the cache: whether they are such as `make` makes. Others are made anew.
template <class... T, class Make, class IsSound>
std::tuple<std::vector<T>...> kept_lists(const std::filesystem::path& cache, const Digest& key,
                                         const Make& make, const IsSound& is_sound) {
  using Lists = std::tuple<std::vector<T>...>;
  if (cache.empty()) return make();
  if (const auto found = find_lists(cache, key, sizeof...(T))) {
    Lists lists;
    std::size_t at = 0;
    const bool whole = std::apply(
        [&](auto&... list) { return (detail::take_list(found->lists[at++], list) && ...); }, lists);
    if (whole && std::apply(is_sound, std::as_const(lists)) && !found->file->was_cut())
      return lists;
    warn_of_damage(cache, key);
  }
  Lists lists = make();
  std::apply([&](const auto&... list) { keep_lists(cache, key, {bytes_of(std::span(list))...}); },
             lists);
  return lists;
}

}  // namespace crowdface
