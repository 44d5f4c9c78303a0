// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/merge_reviews.h"

#include <algorithm>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using Verdict = ReviewMark::Verdict;

const char* verb_of(const ReviewMark& mark) {
  if (mark.verdict == Verdict::kKeep) return "keeps it";
  return mark.locked_bands.empty() ? "rejects it" : "rejects it and locks parts";
}

/// Adapts a later review to an earlier review, if the later reviewer did not see the results of the
/// earlier review. Removes from the later review all requests that the earlier review contains, and
/// notes conflicts.
class ReviewMerger {
 public:
  ReviewMerger(const Review& earlier, std::size_t earlier_number, Review& later,
               std::size_t later_number, std::vector<std::string>& conflicts)
      : earlier_(earlier),
        earlier_name_(concat("review ", earlier_number)),
        later_(later),
        later_name_(concat("review ", later_number)),
        conflicts_(conflicts) {}

  void merge() {
    for (ReviewMark& mark : later_.marks) {
      if (const ReviewMark* other = mark_of(mark.id, earlier_)) merge(*other, mark);
      if (change_of(mark.id, earlier_) != nullptr && mark.verdict == Verdict::kReject) {
        tell(mark.id, "changes it", verb_of(mark));
      }
    }
    for (FaceChange& change : later_.changes) {
      const ReviewMark* mark = mark_of(change.id, earlier_);
      if (mark != nullptr && mark->verdict == Verdict::kReject) {
        tell(change.id, verb_of(*mark), "changes it");
      }
      if (const FaceChange* other = change_of(change.id, earlier_)) merge(*other, change);
    }
    std::erase_if(later_.changes, [](const FaceChange& change) { return change.is_empty(); });
  }

 private:
  static const ReviewMark* mark_of(const std::string& id, const Review& review) {
    const auto found = std::ranges::find(review.marks, id, &ReviewMark::id);
    return found == review.marks.end() ? nullptr : &*found;
  }
  static const FaceChange* change_of(const std::string& id, const Review& review) {
    const auto found = std::ranges::find(review.changes, id, &FaceChange::id);
    return found == review.changes.end() ? nullptr : &*found;
  }
  void tell(const std::string& id, const std::string& first, const std::string& second) {
    conflicts_.push_back(
        concat(id, ": ", earlier_name_, ' ', first, ", ", later_name_, ' ', second));
  }

  void merge(const ReviewMark& other, ReviewMark& mark) {
    if (other.verdict != mark.verdict || other.locked_bands != mark.locked_bands) {
      tell(mark.id, verb_of(other), verb_of(mark));
    }
    if (other.verdict == Verdict::kReject) {  // the earlier review already redraws the face
      mark.verdict = Verdict::kKeep;
      mark.locked_bands.clear();
    }
    if (other.note && mark.note != other.note) {
      mark.note = mark.note ? concat(*other.note, "; ", *mark.note) : *other.note;
    }
  }

  /// Clears `value`, a value of the later change, if the earlier change sets the same value
  /// (`other`). Adds a conflict if the earlier change sets a different value.
  template <class Value>
  void merge(const char* key, const std::string& id, const Value& other, Value& value) {
    if (other == Value() || value == Value()) return;
    if (other == value) {
      value = Value();
    } else {
      tell(id, concat("changes its ", key), concat("changes its ", key, " in another way"));
    }
  }

  void merge(const FaceChange& other, FaceChange& change) {
    const bool is_same_variant = other.variant_distance_mm == change.variant_distance_mm;
    merge("age", change.id, other.age_step, change.age_step);
    merge("age", change.id, other.age, change.age);
    if (is_same_variant || !other.variant_of || !change.variant_of) {
      merge("variant_of", change.id, other.variant_of, change.variant_of);
    } else {
      tell(change.id, "makes it a variant", "makes it another variant");
    }
    merge("group", change.id, other.group, change.group);
    merge("lock", change.id, other.locked_bands, change.locked_bands);
    merge("traits", change.id, other.traits, change.traits);
    merge("wears", change.id, other.attachments, change.attachments);
    merge("takes_off", change.id, other.removed_attachments, change.removed_attachments);
    merge("hair", change.id, other.hair, change.hair);
    merge("colours", change.id, other.colours, change.colours);
  }

  const Review& earlier_;
  std::string earlier_name_;
  Review& later_;
  std::string later_name_;
  std::vector<std::string>& conflicts_;
};

}  // namespace

MergedReviews merged_reviews(const std::vector<Review>& reviews) {
  MergedReviews merged{reviews, {}};
  for (std::size_t later = 0; later < reviews.size(); ++later) {
    const auto seen =
        static_cast<std::size_t>(reviews[later].review_count_seen_by_reviewer.value_or(later));
    for (std::size_t earlier = seen; earlier < later; ++earlier) {
      ReviewMerger(reviews[earlier], earlier + 1, merged.reviews[later], later + 1,
                   merged.conflicts)
          .merge();
    }
  }
  return merged;
}

}  // namespace crowdface
