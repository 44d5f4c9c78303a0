// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/morph_targets.h"

#include <algorithm>
#include <string_view>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/little_endian.h"

namespace crowdface {
namespace {

constexpr std::string_view kBefore = "data/targets/", kAfter = ".target";
constexpr std::size_t kBytes = 2;

std::string short_name(const std::string& path) {
  std::string_view name = path;
  if (name.starts_with(kBefore)) name.remove_prefix(kBefore.size());
  if (name.ends_with(kAfter)) name.remove_suffix(kAfter.size());
  return std::string(name);
}

}  // namespace

MorphTargets::MorphTargets(const std::filesystem::path& file, std::vector<std::string> names,
                           Index vertex_count)
    : path_(file), file_(file), vertex_count_(static_cast<std::size_t>(vertex_count)) {
  const std::size_t expected = names.size() * vertex_count_ * 3 * kBytes;
  if (file_.bytes().size() != expected) {
    refuse_file(file, concat("expected ", expected, " bytes for ", names.size(), " targets of ",
                             vertex_count_, " vertices, found ", file_.bytes().size()));
  }
  std::ranges::sort(names);
  for (std::size_t i = 0; i < names.size(); ++i) target_indices_[short_name(names[i])] = i;
}

void MorphTargets::add_displacements(const TargetWeight& target,
                                     std::span<const std::uint32_t> rows,
                                     Positions& positions) const {
  const auto place = target_indices_.find(target.target);
  if (place == target_indices_.end()) {
    refuse_file(path_,
                concat("expected a target ", quoted(target.target), ", found none of that name"));
  }
  const char* first = file_.bytes().data() + place->second * vertex_count_ * 3 * kBytes;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const char* row = first + std::size_t{rows[i]} * 3 * kBytes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      positions(static_cast<Index>(i), static_cast<Index>(axis)) +=
          target.weight * number_at<std::int16_t>(row + axis * kBytes) / 1000.0;
    }
  }
}

}  // namespace crowdface
