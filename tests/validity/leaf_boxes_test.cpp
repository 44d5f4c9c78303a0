// SPDX-License-Identifier: Apache-2.0
#include "crowdface/validity/leaf_boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

/// Eight triangles anywhere, some of them small and far off, where single precision is coarse.
class LeafBoxesTest : public ::testing::Test {
 protected:
  LeafBoxesTest() : positions_(24, 3) {
    std::mt19937 random(3);
    const auto one = [&] { return static_cast<double>(random()) / 4294967295.0; };
    for (Index v = 0; v < positions_.rows(); ++v) {
      const double size = v % 6 < 3 ? 1 : 1e-4, off = v % 6 < 3 ? 0 : 0.7;
      for (Index c = 0; c < 3; ++c) positions_(v, c) = off + size * one();
    }
    for (std::uint32_t t = 0; t < 8; ++t) triangles_.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    points_ = positions_.cast<float>();
  }
  LeafCorners corners(std::size_t count) const {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0U);
    return {numbers, triangles_};
  }

  Positions positions_;
  std::vector<Triangle> triangles_;
  FloatPositions points_;
};

TEST_F(LeafBoxesTest, HoldTheirTrianglesWithTheMargin) {
  for (const double margin : {0.0, 0.25, 0.7}) {
    const LeafBoxes boxes(corners(8), points_, margin);
    for (std::size_t t = 0; t < 8; ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto axis = static_cast<Index>(c);
        double low = 1e9, high = -1e9;
        for (const std::uint32_t v : triangles_[t]) {
          low = std::min(low, positions_(v, axis));
          high = std::max(high, positions_(v, axis));
        }
        EXPECT_LE(boxes.low[c][t], low - margin);
        EXPECT_GE(boxes.high[c][t], high + margin);
        EXPECT_NEAR(boxes.low[c][t], low - margin, 1e-5);
        EXPECT_NEAR(boxes.high[c][t], high + margin, 1e-5);
      }
    }
    const Box whole = boxes.bounding_box();
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(whole.low[c], *std::ranges::min_element(boxes.low[c]));
      EXPECT_EQ(whole.high[c], *std::ranges::max_element(boxes.high[c]));
    }
  }
}

TEST_F(LeafBoxesTest, WhereThereAreFewerTheRestOverlapsNothing) {
  const LeafBoxes few(corners(3), points_, 0.1), all(corners(8), points_, 10);
  EXPECT_EQ(overlap_mask(few, all), 0x0000'0000'00ff'ffffU);
  EXPECT_EQ(overlap_mask(all, few), 0x0707'0707'0707'0707U);
}

TEST_F(LeafBoxesTest, BitsAreThoseOfEachPair) {
  const LeafBoxes boxes(corners(8), points_, 0.01);
  const LeafNormals normals(corners(8), points_);
  const std::uint64_t near = overlap_mask(boxes, boxes),
                      alike = similar_normal_mask(normals, normals, 0.3F);
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) {
      bool meet = true;
      for (std::size_t c = 0; c < 3; ++c) {
        meet = meet && boxes.low[c][i] <= boxes.high[c][j] && boxes.low[c][j] <= boxes.high[c][i];
      }
      EXPECT_EQ(near >> (8 * i + j) & 1, meet ? 1U : 0U);
      const double cosine = area_vector(positions_, triangles_[i])
                                .normalized()
                                .dot(area_vector(positions_, triangles_[j]).normalized());
      if (std::abs(cosine - 0.3) > 0.01) {
        EXPECT_EQ(alike >> (8 * i + j) & 1, cosine > 0.3 ? 1U : 0U) << i << ' ' << j;
      }
    }
  }
}

}  // namespace
}  // namespace crowdface
