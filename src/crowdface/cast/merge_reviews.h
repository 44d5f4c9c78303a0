// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/review.h"

namespace crowdface {

/// Reviews to apply one after the other.
struct MergedReviews {
  std::vector<Review> reviews;
  /// Disagreements between reviews whose reviewers did not see each other's results, one line of
  /// text for each disagreement.
  std::vector<std::string> conflicts;
};

/// Merges reviews whose reviewers did not see each other's results (see
/// Review::review_count_seen_by_reviewer). Equal requests apply once: a face that both reviews
/// reject is redrawn once, and a change that both reviews request is made once. Both notes stay. If
/// two reviews disagree,
///
/// - a face that only one review rejects is redrawn;
/// - if both reviews reject a face with different locked parts, the earlier review applies;
/// - if both reviews change the same key of a face, the later review is applied last.
MergedReviews merged_reviews(const std::vector<Review>& reviews);

}  // namespace crowdface
