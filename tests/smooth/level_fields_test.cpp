// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_fields.h"

#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/core/instruction_set.h"
#include "crowdface/core/random.h"

namespace crowdface {
namespace {

/// Three fields, of which the second is a thousandth of the first and the third is zero.
std::vector<float> some_fields(Index vertices) {
  std::vector<float> fields;
  for (const double size : {80.0, 0.08, 0.0}) {
    for (Index i = 0; i < 3 * vertices; ++i) {
      const auto at = static_cast<std::uint64_t>(i);
      fields.push_back(static_cast<float>(size * random_between({1, at, "field", 0}, -1, 1)));
    }
  }
  return fields;
}

TEST(LevelFields, AreOffByHalfAStepAtMost) {
  for (const Index vertices : {1, 63, 64, 65, 1000}) {
    const std::vector<float> exact = some_fields(vertices);
    const LevelFields fields = in_16_bits(exact, vertices);
    ASSERT_EQ(fields.rank(), 3);
    EXPECT_NEAR(fields.steps[0], 80.0 / 32767, 80.0 / 32767);
    EXPECT_LT(fields.steps[1], 0.0011 * 80.0 / 32767 + fields.steps[0]);
    EXPECT_EQ(fields.steps[2], 0);
    auto value = exact.begin();
    for (Index p = 0; p < fields.rank(); ++p) {
      const double half = 0.5 * fields.steps[static_cast<std::size_t>(p)];
      double worst = 0;
      for (Index i = 0; i < 3 * vertices; ++i) {
        worst = std::max(worst,
                         std::abs(fields.value(p, i / 3, i % 3) - static_cast<double>(*value++)));
      }
      EXPECT_LE(worst, 1.01 * half) << p << " of " << vertices;
    }
  }
}

TEST(LevelFields, KeepTheLargestNumberAndZero) {
  const std::vector<float> values = {0, 0.3F, -0.7F};
  const LevelFields fields = in_16_bits(values, 1);
  EXPECT_EQ(fields.number(0, 0, 0), 0);
  EXPECT_EQ(fields.number(0, 0, 2), -32767);
  EXPECT_NEAR(fields.value(0, 0, 2), static_cast<double>(values[2]), 1e-12);
}

TEST(LevelFields, AreZeroPastTheLastVertex) {
  const LevelFields fields = in_16_bits(some_fields(70), 70);
  ASSERT_EQ(fields.numbers.size(), 2 * 3 * 3 * kFieldTile);
  std::size_t past = 0;
  for (std::size_t i = 0; i < fields.numbers.size(); ++i) {
    const std::size_t vertex = i / (3 * 3 * kFieldTile) * kFieldTile + i % (3 * kFieldTile) / 3;
    if (vertex < 70) continue;
    EXPECT_EQ(fields.numbers[i], 0);
    ++past;
  }
  EXPECT_EQ(past, 58U * 3 * 3);
}

TEST(LevelFields, AreTheSameOnEveryInstructionSet) {
  const std::vector<float> exact = some_fields(500);
  const LevelFields expected = in_16_bits(exact, 500);
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    const LevelFields fields = in_16_bits(exact, 500);
    EXPECT_EQ(fields.steps, expected.steps) << name;
    EXPECT_TRUE(std::ranges::equal(fields.numbers, expected.numbers)) << name;
  }
  use_instruction_set(instruction_sets().front());
}

}  // namespace
}  // namespace crowdface
