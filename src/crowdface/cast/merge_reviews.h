// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/review.h"

namespace crowdface {

/// Reviews to apply one after the other.
struct MergedReviews {
  std::vector<Review> reviews;
  /// Disagreements between reviews that were made at the same time, a line for each face.
  std::vector<std::string> conflicts;
};

/// Merges reviews whose reviewers did not see each other's results (see Review::seen_reviews).
/// Equal requests apply once: a face that both reviews reject is redrawn once, and equal keys of
/// changes apply once. Both notes stay. If two reviews disagree,
///
/// - a face that only one review rejects is redrawn;
/// - of two rejections with different locked parts, the rejection of the earlier review applies;
/// - of two changes of the same key, the change of the later review applies last.
MergedReviews merged_reviews(const std::vector<Review>& reviews);

}  // namespace crowdface
