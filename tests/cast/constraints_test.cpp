// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/constraints.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

// The last reason was once counted beyond the end.
TEST(RejectionCounts, EveryReasonIsCountedApart) {
  RejectionCounts all;
  std::set<std::string> names;
  for (const RejectionReason reason :
       {RejectionReason::kMinDistance, RejectionReason::kMinDistanceToHeads,
        RejectionReason::kMaxWeight, RejectionReason::kImplausible, RejectionReason::kFlipped,
        RejectionReason::kStretched, RejectionReason::kIntersecting, RejectionReason::kGap,
        RejectionReason::kExposed, RejectionReason::kFamily, RejectionReason::kRejected,
        RejectionReason::kTraits}) {
    RejectionCounts one;
    one.add(reason, 3);
    EXPECT_EQ(one.total(), 3U) << name_of(reason);
    EXPECT_EQ(one.most_frequent(), reason);
    EXPECT_TRUE(names.insert(std::string(name_of(reason))).second) << name_of(reason);
    all.add(one);
  }
  EXPECT_EQ(names.size(), kReasonCount);
  EXPECT_EQ(all.total(), 3 * kReasonCount);
}

TEST(Constraints, MessagesNameTheKeyAndItsLimit) {
  DiversityOptions diversity;
  diversity.min_distance_mm = 1.25;
  BelievabilityOptions believability;
  believability.max_exposed_mm2 = 4.5;
  EXPECT_EQ(describe(RejectionReason::kMinDistance, diversity, believability),
            "diversity.min_distance, 1.25 mm");
  EXPECT_EQ(describe(RejectionReason::kMinDistanceToHeads, diversity, believability),
            "the rule that no face looks like a head (diversity.min_distance_to_faces is not set)");
  diversity.min_distance_to_heads_mm = 0.8;
  EXPECT_EQ(describe(RejectionReason::kMinDistanceToHeads, diversity, believability),
            "diversity.min_distance_to_faces, 0.8 mm");
  EXPECT_EQ(
      describe_violation(RejectionReason::kExposed, diversity, believability),
      "the lining of nose, lips or lids shows through the skin by more than the limit, 4.5 mm²");
  for (std::size_t r = 0; r < kReasonCount; ++r) {
    EXPECT_FALSE(constraint_of(static_cast<RejectionReason>(r)).advice.empty()) << r;
  }
}

}  // namespace
}  // namespace crowdface
