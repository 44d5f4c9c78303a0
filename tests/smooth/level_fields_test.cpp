// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_fields.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/core/instruction_set.h"
#include "crowdface/core/random.h"
#include "crowdface/smooth/field_kernels.h"

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
    const LevelFields fields = quantize(exact, vertices);
    ASSERT_EQ(fields.rank, 3);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const auto at = static_cast<Index>(i) % (3 * vertices);
      const std::size_t p = i / static_cast<std::size_t>(3 * vertices);
      const auto tile = static_cast<std::size_t>(at / 3) / kTileVertices;
      const double half =
          0.5 *
          static_cast<double>(fields.quantization_steps[fields.first_field_of_tile[tile] + p]);
      EXPECT_LE(std::abs(fields.value(static_cast<Index>(p), at / 3, at % 3) -
                         static_cast<double>(exact[i])),
                half);
    }
  }
}

TEST(LevelFields, HaveStepsThatAreTheLeastPowersOfTwo) {
  const auto step_of_one = [](float largest) { return quantization_step(std::span(&largest, 1)); };
  EXPECT_EQ(step_of_one(32767), 1);
  EXPECT_EQ(step_of_one(-32767), 1);
  EXPECT_EQ(step_of_one(32768), 2);
  EXPECT_EQ(step_of_one(16384), 1);
  EXPECT_EQ(step_of_one(16383.5F), 0.5F);
  EXPECT_EQ(step_of_one(0), 0);
  EXPECT_EQ(step_of_one(1e-40F), 0) << "whose inverse is no number";
  for (const float large : {80.0F, 3e-7F, 1e20F}) {
    const float step = step_of_one(large);
    EXPECT_LE(std::abs(large / step), 32767.5F);
    EXPECT_GT(std::abs(large / step), 16383.4F);
  }
}

TEST(LevelFields, KeepTheLargestNumberAndZero) {
  const std::vector<float> values = {0, 0.25F, -0.75F};
  const LevelFields fields = quantize(values, 1);
  EXPECT_EQ(fields.quantized_values[0], 0);
  EXPECT_EQ(fields.quantized_values[2], -24576);
  for (Index c = 0; c < 3; ++c) {
    EXPECT_EQ(fields.value(0, 0, c), static_cast<double>(values[static_cast<std::size_t>(c)]));
  }
}

TEST(LevelFields, AreZeroPastTheLastVertex) {
  const LevelFields fields = quantize(some_fields(70), 70);
  ASSERT_EQ(fields.quantized_values.size(), 2 * 3 * 3 * kTileVertices);
  std::size_t past = 0;
  for (std::size_t i = 0; i < fields.quantized_values.size(); ++i) {
    const std::size_t vertex =
        i / (3 * 3 * kTileVertices) * kTileVertices + i % (3 * kTileVertices) / 3;
    if (vertex < 70) continue;
    EXPECT_EQ(fields.quantized_values[i], 0);
    ++past;
  }
  EXPECT_EQ(past, 58U * 3 * 3);
}

/// Tiles need not have all fields, nor any: the others are zero there.
TEST(LevelFields, OfATileAreTheFirstFew) {
  std::vector<float> values(2 * kTileValues, 3.0F);
  std::fill_n(values.begin(), kTileValues, 5.0F);
  std::vector<QuantizedTiles> parts(2);
  parts[0].add(values, 1);
  parts[0].add(values, 0);
  parts[1].add(values, 2);
  const LevelFields fields = concatenate(3 * kTileVertices, 2, std::move(parts));
  for (Index v = 0; v < fields.vertex_count; ++v) {
    EXPECT_EQ(fields.value(0, v, 1), v / Index{kTileVertices} == 1 ? 0 : 5) << v;
    EXPECT_EQ(fields.value(1, v, 2), v < 2 * Index{kTileVertices} ? 0 : 3) << v;
  }
  EXPECT_EQ(fields.quantized_values.size(), 3 * kTileValues);
}

/// Against the plain sum, for every number of fields kept.
TEST(LevelFields, KeepsTheFewestThatMissLittleEnough) {
  constexpr std::size_t kFields = 5, kLevelCount = 7;
  std::vector<float> values(kFields * kTileValues), functions(kFields * kLevelCount);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double size = std::pow(0.2, static_cast<double>(i / kTileValues));
    values[i] = static_cast<float>(size * random_between({1, i, "value", 0}, -1, 1));
  }
  for (std::size_t i = 0; i < functions.size(); ++i) {
    functions[i] = static_cast<float>(random_between({1, i, "function", 0}, -1, 1));
  }
  std::vector<double> missed;  // squared, with so many kept
  std::vector<std::size_t> where;
  for (std::size_t kept = 0; kept <= kFields; ++kept) {
    missed.push_back(0);
    where.push_back(0);
    for (std::size_t l = 0; l < kLevelCount; ++l) {
      for (std::size_t v = 0; v < kTileVertices; ++v) {
        double squared = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          double sum = 0;
          for (std::size_t p = kept; p < kFields; ++p) {
            sum += static_cast<double>(functions[l * kFields + p]) *
                   static_cast<double>(values[p * kTileValues + c * kTileVertices + v]);
          }
          squared += sum * sum;
        }
        if (squared > missed.back()) {
          missed.back() = squared;
          where.back() = l;
        }
      }
    }
  }
  for (const std::string& name : instruction_sets()) {
    SCOPED_TRACE(name);
    use_instruction_set(name);
    for (std::size_t kept = 0; kept <= kFields; ++kept) {
      const TruncationError found =
          choose_fewest_fields(values.data(), kFields, functions.data(), kFields, kLevelCount,
                               static_cast<float>(missed[kept] * 1.001));
      EXPECT_EQ(found.kept_fields, kept);
      EXPECT_NEAR(static_cast<double>(found.squared_error), missed[kept], 1e-5 * missed[kept]);
      EXPECT_EQ(found.level_index, where[kept]);
    }
  }
  use_instruction_set(instruction_sets().front());
}

TEST(LevelFields, AreTheSameOnEveryInstructionSet) {
  const std::vector<float> exact = some_fields(500);
  const LevelFields expected = quantize(exact, 500);
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    const LevelFields fields = quantize(exact, 500);
    EXPECT_TRUE(std::ranges::equal(fields.quantization_steps, expected.quantization_steps)) << name;
    EXPECT_TRUE(std::ranges::equal(fields.quantized_values, expected.quantized_values)) << name;
  }
  use_instruction_set(instruction_sets().front());
}

}  // namespace
}  // namespace crowdface
