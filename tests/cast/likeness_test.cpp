// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/likeness.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

namespace crowdface {
namespace {

FaceSpace::Place place_at(float x, float y) {
  const Eigen::VectorXf point = Eigen::Vector2f(x, y);
  return {point, point};
}

std::vector<FaceSpace::Place> random_places(std::uint64_t count) {
  std::vector<FaceSpace::Place> places;
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto [x, y] = random_pair({3, i, "place", 0});
    places.push_back(place_at(static_cast<float>(x), static_cast<float>(y)));
  }
  return places;
}

TEST(Likeness, OfNobodyIsEmpty) {
  EXPECT_TRUE(find_likeness({}, 4).order.empty());
}

TEST(Likeness, OfOneFaceIsThatFace) {
  const Likeness likeness = find_likeness({place_at(1, 2)}, 4);
  EXPECT_EQ(likeness.order, std::vector<std::size_t>{0});
  EXPECT_TRUE(likeness.near[0].empty());
}

TEST(Likeness, NeighboursAreThoseOfASearchThroughAll) {
  const auto places = random_places(150);
  const Likeness likeness = find_likeness(places, 5);
  for (std::size_t face = 0; face < places.size(); ++face) {
    std::vector<double> mm;
    for (std::size_t other = 0; other < places.size(); ++other) {
      if (other != face) mm.push_back(FaceSpace::distance(places[face], places[other]));
    }
    std::sort(mm.begin(), mm.end());
    ASSERT_EQ(likeness.near[face].size(), 5U);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(likeness.near[face][k].mm, mm[k]);
  }
}

TEST(Likeness, OrderNamesEveryFaceOnce) {
  Likeness likeness = find_likeness(random_places(211), 1);
  std::sort(likeness.order.begin(), likeness.order.end());
  for (std::size_t i = 0; i < likeness.order.size(); ++i) EXPECT_EQ(likeness.order[i], i);
  EXPECT_EQ(likeness.order.size(), 211U);
}

TEST(Likeness, FacesThatAreEachOthersNearestStandSideBySide) {
  const Likeness likeness = find_likeness(random_places(300), 1);
  std::vector<std::size_t> place(300);
  for (std::size_t i = 0; i < 300; ++i) place[likeness.order[i]] = i;
  int pairs = 0;
  for (std::size_t face = 0; face < 300; ++face) {
    const std::size_t other = likeness.near[face][0].face;
    if (likeness.near[other][0].face != face) continue;
    ++pairs;
    EXPECT_EQ(std::max(place[face], place[other]) - std::min(place[face], place[other]), 1U);
  }
  EXPECT_GT(pairs, 100);
}

}  // namespace
}  // namespace crowdface
