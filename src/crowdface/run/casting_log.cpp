// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/casting_log.h"

#include <algorithm>

#include "crowdface/core/log.h"
#include "crowdface/core/text.h"

namespace crowdface {

std::optional<std::string> near_heads(const Cast& cast, const std::vector<std::string>& heads) {
  constexpr double kSamePersonMm = 0.5;  // docs/casting.md
  constexpr std::size_t kMostNamed = 8;
  std::vector<std::string> near;
  for (const CastFace& face : cast.crowd) {
    if (!face.index || !face.notes.nearest || face.notes.nearest->head_mm >= kSamePersonMm)
      continue;
    near.push_back(concat(face.id, " (", heads[static_cast<std::size_t>(face.notes.nearest->head)],
                          ", ", format_fixed(face.notes.nearest->head_mm, 2), " mm)"));
  }
  if (near.empty()) return std::nullopt;
  const std::size_t count = near.size();
  near.resize(std::min(count, kMostNamed));
  return concat(count, count == 1 ? " face passes" : " faces pass",
                " for one of the heads: ", join(near), count > kMostNamed ? ", …" : "",
                "; diversity.min_distance_to_faces keeps faces away from them");
}

void log_casting(const Cast& cast, const std::vector<std::string>& heads) {
  const CrowdDistances& distances = cast.distances;
  const auto mm = [](double value) { return format_fixed(value, 2); };
  if (distances.crowd.count > 0) {
    log_info(concat("distances between faces: closest ", mm(distances.crowd.min), " mm, median ",
                    mm(distances.crowd.median), " mm; between the input heads: closest ",
                    mm(distances.heads.min), " mm, median ", mm(distances.heads.median),
                    " mm; ratio of the medians ", mm(distances.ratio)));
  }
  std::vector<std::string> thrown;
  for (std::size_t r = 0; r < kReasonCount; ++r) {
    const std::uint64_t count = cast.rejections.count[r];
    if (count > 0) thrown.push_back(concat(count, " for ", name_of(static_cast<Reason>(r))));
  }
  if (!thrown.empty()) log_info(concat("candidates thrown away: ", join(thrown)));
  if (const auto text = near_heads(cast, heads)) log_warning(*text);
}

}  // namespace crowdface
