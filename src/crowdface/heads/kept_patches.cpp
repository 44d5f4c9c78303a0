// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/kept_patches.h"

#include <optional>
#include <utility>

#include "crowdface/heads/kept_lists.h"

namespace crowdface {
namespace {

/// Where they lie: a file is mapped at a page, and all lists before the last have a multiple of four bytes.
template <class T>
std::span<const T> as_list(std::string_view bytes) {
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

std::optional<KeptPatches> find_patches(const std::filesystem::path& cache, const Digest& key,
                                        Index vertex_count, std::span<const Index> ranks) {
  constexpr std::size_t kLists = 6;
  const auto found = find_lists(cache, key, kLists);
  if (!found) return std::nullopt;
  const auto& lists = found->lists;
  auto patches = FieldPatches::of(
      {.vertices = as_list<std::uint32_t>(lists[1]),
       .skeletons = as_list<std::uint32_t>(lists[2]),
       .counts = as_list<std::uint32_t>(lists[3]),
       .steps = as_list<float>(lists[4]),
       .weights =
           as_list<float>(lists[0]),  // first, where the most vectors of them lie in one line
       .numbers = as_list<std::int16_t>(lists[5]),
       .owner = found->file},
      vertex_count, ranks);
  if (patches && !found->file->was_cut()) return KeptPatches{*std::move(patches), found->file};
  warn_of_damage(cache, key);
  return std::nullopt;
}

}  // namespace

KeptPatches kept_patches(const std::filesystem::path& cache, const Digest& key, Index vertex_count,
                         std::span<const Index> ranks, const std::function<FieldPatches()>& make) {
  if (auto found = find_patches(cache, key, vertex_count, ranks)) return *std::move(found);
  FieldPatches made = make();
  const PatchLists& lists = made.lists();
  const bool kept =
      keep_lists(cache, key,
                 {bytes_of(lists.weights), bytes_of(lists.vertices), bytes_of(lists.skeletons),
                  bytes_of(lists.counts), bytes_of(lists.steps), bytes_of(lists.numbers)});
  if (kept) {  // used from there from now on: memory holds them once
    if (auto found = find_patches(cache, key, vertex_count, ranks)) return *std::move(found);
  }
  return {std::move(made), nullptr};
}

}  // namespace crowdface
