// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/diversity.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

// The last reason was once counted beyond the end.
TEST(Rejections, EveryReasonIsCountedApart) {
  Rejections all;
  std::set<std::string> names;
  for (const Reason reason :
       {Reason::kMinDistance, Reason::kMinDistanceToFaces, Reason::kMaxWeight, Reason::kImplausible,
        Reason::kFlipped, Reason::kStretched, Reason::kIntersecting, Reason::kGap, Reason::kExposed,
        Reason::kFamily, Reason::kRejected}) {
    Rejections one;
    one.add(reason, 3);
    EXPECT_EQ(one.total(), 3U) << name_of(reason);
    EXPECT_EQ(one.most_frequent(), reason);
    EXPECT_TRUE(names.insert(std::string(name_of(reason))).second) << name_of(reason);
    all.add(one);
  }
  EXPECT_EQ(names.size(), kReasonCount);
  EXPECT_EQ(all.total(), 3 * kReasonCount);
}

}  // namespace
}  // namespace crowdface
