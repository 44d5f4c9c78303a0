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
/// Review::review_count_seen_by_reviewer). The rules for two such reviews are:
///
/// - If both reviews reject a face, the face is redrawn once. If both reviews request the same
///   change, the change is made once.
/// - If both reviews have a note about a face, the merged review has both notes.
/// - If only one review rejects a face, the face is redrawn.
/// - If both reviews reject a face but lock different parts, the face is redrawn with the locked
///   parts of the earlier review.
/// - If both reviews change the same key of a face in different ways, both changes are applied,
///   first the change of the earlier review. So the later review determines the result.
MergedReviews merged_reviews(const std::vector<Review>& reviews);

}  // namespace crowdface
