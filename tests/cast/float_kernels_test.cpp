// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/float_kernels.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

std::vector<float> random_floats(std::size_t count) {
  static std::mt19937 generator(7);
  std::uniform_real_distribution<float> value(-3, 3);
  std::vector<float> floats(count);
  for (float& number : floats) number = value(generator);
  return floats;
}

/// Widths with and without whole registers of each instruction set.
class FloatKernels : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FloatKernels, HaveTheBitsOfPlainLoops) {
  const std::size_t width = GetParam(), count = 113;
  std::vector<float> factors = random_floats(3 * count);
  const std::vector<float> rows = random_floats(count * width), start = random_floats(3 * width);
  for (std::size_t i = 0; i < count; i += 3) factors[i] = factors[count + i] = 0;
  std::vector<float> sums = start, plain = start;
  add_product(factors.data(), 3, count, rows.data(), width, sums.data());
  for (std::size_t v = 0; v < 3; ++v) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t d = 0; d < width; ++d)
        plain[v * width + d] += factors[v * count + i] * rows[i * width + d];
    }
  }
  EXPECT_EQ(sums, plain);

  add_scaled(factors[0], rows.data(), width, sums.data());
  for (std::size_t d = 0; d < width; ++d) plain[d] += factors[0] * rows[d];
  EXPECT_EQ(sums, plain);
}

INSTANTIATE_TEST_SUITE_P(Widths, FloatKernels, ::testing::Values(1, 3, 16, 37, 64, 85, 150));

class FloatKernelsDot : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FloatKernelsDot, HasTheBitsOfSixteenPlainSumsAChunk) {
  constexpr std::size_t kSums = 16, kChunk = 1024;
  const std::size_t count = GetParam();
  const std::vector<float> a = random_floats(count), b = random_floats(count);
  double plain = 0;
  for (std::size_t begin = 0; begin < count; begin += kChunk) {
    float sums[kSums] = {};
    for (std::size_t i = begin; i < std::min(begin + kChunk, count); ++i) {
      sums[(i - begin) % kSums] += a[i] * b[i];
    }
    for (const float sum : sums) plain += static_cast<double>(sum);
  }
  EXPECT_EQ(fixed_order_dot(a.data(), b.data(), count), plain);

  std::vector<float> sums = a, expected = a;
  for (std::size_t i = 0; i < count; ++i) expected[i] += 0.3F * b[i];
  EXPECT_EQ(add_scaled_and_sum_squares(0.3F, b.data(), count, sums.data()),
            fixed_order_dot(expected.data(), expected.data(), count));
  EXPECT_EQ(sums, expected);
}

INSTANTIATE_TEST_SUITE_P(Sizes, FloatKernelsDot,
                         ::testing::Values(0, 1, 15, 16, 33, 1024, 1030, 2048, 2500, 3072, 5001));

TEST(FloatKernelsSquares, OfSixteenLanesEndOnlyWhereAllAreBeyond) {
  constexpr std::size_t kLanes = 16, kDimensions = 16;
  const std::vector<float> query = random_floats(kDimensions),
                           rows = random_floats(kDimensions * kLanes);
  std::vector<float> plain(kLanes, 1), sums(kLanes, 1);
  for (std::size_t d = 0; d < kDimensions; ++d) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float difference = query[d] - rows[d * kLanes + lane];
      plain[lane] += difference * difference;
    }
  }
  const float least = *std::min_element(plain.begin(), plain.end());
  EXPECT_TRUE(add_squares(query.data(), rows.data(), kDimensions, least, sums.data()));
  EXPECT_EQ(sums, plain);
  sums.assign(kLanes, 1);
  EXPECT_FALSE(
      add_squares(query.data(), rows.data(), kDimensions, std::nextafter(least, 0.F), sums.data()));
}

}  // namespace
}  // namespace crowdface
