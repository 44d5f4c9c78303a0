// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/field_patches.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

#include "crowdface/core/instruction_set.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/random.h"
#include "crowdface/smooth/tiles.h"

#include "support/smooth_fields.h"

namespace crowdface {
namespace {

constexpr Index kColumns = 50, kRows = 41;
constexpr Index kVertices = kColumns * kRows;
const std::vector<std::uint64_t> kLevels = {0, 1, 2, 5, 20, 100};

std::vector<HeadSmoothing> smooth_heads(std::size_t count) {
  std::vector<HeadSmoothing> heads;
  for (std::size_t h = 0; h < count; ++h)
    heads.push_back(testing::smooth_levels(kColumns, kRows, h));
  return heads;
}

std::vector<std::uint32_t> rows_of_grid() {
  std::vector<std::uint32_t> order(kVertices);
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

/// What a field is at a patch's vertex, told from the skeleton.
double interpolated(const FieldPatch& patch, std::size_t row, std::size_t vertex, std::size_t c) {
  const std::int16_t* numbers =
      patch.quantized_values + row * patch.values_per_field() + c * patch.stored_vertex_count;
  const auto at = [&](std::size_t j) {
    return static_cast<double>(patch.quantization_steps[row]) * static_cast<double>(numbers[j]);
  };
  if (patch.stores_all_vertices()) return at(vertex);
  double sum = 0;
  for (std::size_t j = 0; j < patch.stored_vertex_count; ++j) {
    sum += static_cast<double>(patch.weights[j * kPatchVertices + vertex]) * at(j);
  }
  return sum;
}

/// The largest distance that any vertex misses of any level of any head.
double missed(const std::vector<HeadSmoothing>& heads, const FieldPatches& patches) {
  double most = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const FieldPatch patch = patches[i];
    for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
      std::size_t row = 0;
      for (std::size_t h = 0; h < heads.size(); ++h) {
        for (const std::uint64_t level : kLevels) {
          const std::vector<double> functions = heads[h].functions(level);
          double squared = 0;
          for (std::size_t c = 0; c < 3; ++c) {
            double error = 0;
            for (std::size_t p = 0; p < functions.size(); ++p) {
              const double there =
                  p < patch.field_counts[h] ? interpolated(patch, row + p, v, c) : 0;
              const double exact = heads[h].fields.value(static_cast<Index>(p), patch.vertices[v],
                                                         static_cast<Index>(c));
              error += functions[p] * (there - exact);
            }
            squared += error * error;
          }
          most = std::max(most, std::sqrt(squared));
        }
        row += patch.field_counts[h];
      }
    }
  }
  return most;
}

double mean_skeleton(const FieldPatches& patches) {
  const auto& skeletons = patches.arrays().stored_vertex_counts;
  return std::accumulate(skeletons.begin(), skeletons.end(), 0.0) /
         static_cast<double>(patches.size());
}

bool same_lists(const FieldPatches& a, const FieldPatches& b) {
  const PatchArrays &x = a.arrays(), &y = b.arrays();
  return std::ranges::equal(x.vertices, y.vertices) &&
         std::ranges::equal(x.stored_vertex_counts, y.stored_vertex_counts) &&
         std::ranges::equal(x.field_counts, y.field_counts) &&
         std::ranges::equal(x.quantization_steps, y.quantization_steps) &&
         std::ranges::equal(x.weights, y.weights) &&
         std::ranges::equal(x.quantized_values, y.quantized_values);
}

TEST(FieldPatches, MissNoLevelOfAnyHeadByMoreThanTheTolerance) {
  const auto heads = smooth_heads(5);
  double before = kPatchVertices;
  for (const double tolerance : {0.001, 0.01, 0.1}) {
    const FieldPatches patches = interpolate_fields(heads, kLevels, rows_of_grid(), tolerance);
    // Rounding to 16 bits: at most some steps of 2⁻¹¹, five fields of size ten and less.
    EXPECT_LT(missed(heads, patches), tolerance + 0.003) << tolerance;
    EXPECT_GT(missed(heads, patches), tolerance / 100) << "more vertices kept than needed";
    EXPECT_LT(mean_skeleton(patches), before) << tolerance;
    before = mean_skeleton(patches);
  }
  EXPECT_LT(before, 20);
}

TEST(FieldPatches, HaveEachVertexOnceInTheOrderGiven) {
  const auto heads = smooth_heads(2);
  std::vector<std::uint32_t> order = rows_of_grid();
  std::ranges::reverse(order);
  const FieldPatches patches = interpolate_fields(heads, kLevels, order, 0.01);
  ASSERT_EQ(patches.size(), (kVertices + 127) / 128);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const auto vertices = patches[i].vertices;
    EXPECT_TRUE(std::ranges::is_sorted(vertices));
    EXPECT_EQ(vertices.back(), order[i * kPatchVertices]);
    EXPECT_EQ(vertices.front(), order[i * kPatchVertices + vertices.size() - 1]);
  }
}

TEST(FieldPatches, AreOfStretchesThatLieSideBySide) {
  Positions grid(kVertices, 3);  // its rows one after the other
  for (Index v = 0; v < kVertices; ++v) {
    grid.row(v) << static_cast<double>(v % kColumns), static_cast<double>(v / kColumns), 0;
  }
  const std::vector<std::uint32_t> order = vertex_order_for_patches(grid, 1.5);
  std::vector<std::uint32_t> sorted = order;
  std::ranges::sort(sorted);
  EXPECT_EQ(sorted, rows_of_grid());
  std::size_t breaks = 0;
  for (std::size_t i = 1; i < order.size(); ++i) breaks += order[i] == order[i - 1] + 1 ? 0 : 1;
  EXPECT_LT(breaks, 2 * kRows) << "each row in two stretches of 32 and 18";
  // Where no vertex is near the next in the mesh, the curve alone decides.
  EXPECT_EQ(vertex_order_for_patches(grid, 0.5), hilbert_order(grid));
}

TEST(FieldPatches, KeepAllVerticesWhereNoneIsLikeAnother) {
  std::vector<float> noise;
  for (Index i = 0; i < 8 * 3 * kVertices; ++i) {
    noise.push_back(
        static_cast<float>(random_between({1, static_cast<std::uint64_t>(i), "noise", 0}, -1, 1)));
  }
  const std::vector<HeadSmoothing> heads = {
      {quantize(noise, kVertices),
       [](std::uint64_t level) { return std::vector<double>(8, level == 0 ? 0.0 : 1.0); }}};
  const FieldPatches patches = interpolate_fields(heads, kLevels, rows_of_grid(), 0.001);
  EXPECT_TRUE(patches.arrays().weights.empty());
  EXPECT_LT(missed(heads, patches), 1e-4) << "rounded to 16 bits";
}

TEST(FieldPatches, AVertexThatNothingMovesIsMovedByNothing) {
  const auto heads = smooth_heads(6);  // whose grid's first column stands still
  const FieldPatches patches = interpolate_fields(heads, kLevels, rows_of_grid(), 0.1);
  std::size_t still = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const FieldPatch patch = patches[i];
    if (patch.stores_all_vertices()) continue;  // the last, of two vertices
    for (std::size_t v = 0; v < patch.vertices.size(); ++v) {
      if (patch.vertices[v] % kColumns != 0) continue;
      ++still;
      for (std::size_t j = 0; j < patch.stored_vertex_count; ++j) {
        EXPECT_EQ(patch.weights[j * kPatchVertices + v], 0);
      }
    }
  }
  EXPECT_GE(still, kRows - 1);
}

TEST(FieldPatches, OfHeadsThatStandStillAreEmpty) {
  const std::vector<HeadSmoothing> heads = {
      {quantize(std::vector<float>(2 * 3 * kVertices, 0.0F), kVertices),
       [](std::uint64_t) { return std::vector<double>(2, 1.0); }}};
  const FieldPatches patches = interpolate_fields(heads, kLevels, rows_of_grid(), 0.01);
  EXPECT_EQ(mean_skeleton(patches), 0);
  EXPECT_EQ(missed(heads, patches), 0);
}

TEST(FieldPatches, AreTheSameOnAnyMachine) {
  const auto heads = smooth_heads(4);
  const FieldPatches expected = interpolate_fields(heads, kLevels, rows_of_grid(), 0.01);
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    const ThreadLimit one(1);
    EXPECT_TRUE(same_lists(interpolate_fields(heads, kLevels, rows_of_grid(), 0.01), expected))
        << name;
  }
  use_instruction_set(instruction_sets().front());
}

TEST(FieldPatches, RefuseListsThatAreNotOfPatches) {
  const auto heads = smooth_heads(6);
  const FieldPatches made = interpolate_fields(heads, kLevels, rows_of_grid(), 0.1);
  ASSERT_FALSE(made.arrays().weights.empty());
  const std::vector<Index> ranks(heads.size(), heads[0].fields.rank);
  const auto taken = [&](const PatchArrays& arrays) {
    return FieldPatches::from_arrays(arrays, kVertices, ranks).has_value();
  };
  ASSERT_TRUE(taken(made.arrays()));
  const auto with = [&](auto PatchArrays::*list, auto change) {
    using T = std::remove_cv_t<
        typename std::remove_reference_t<decltype(made.arrays().*list)>::element_type>;
    std::vector<T> values((made.arrays().*list).begin(), (made.arrays().*list).end());
    change(values);
    PatchArrays arrays = made.arrays();
    arrays.*list = values;
    return taken(arrays);
  };
  EXPECT_FALSE(with(&PatchArrays::vertices, [](auto& v) { v[3] = kVertices; }));
  EXPECT_FALSE(with(&PatchArrays::vertices, [](auto& v) { v[3] = v[4]; }));
  EXPECT_FALSE(with(&PatchArrays::vertices, [](auto& v) { std::swap(v[3], v[4]); }));
  EXPECT_FALSE(with(&PatchArrays::vertices, [](auto& v) { v.pop_back(); }));
  EXPECT_FALSE(with(&PatchArrays::stored_vertex_counts, [](auto& v) { v[0] = 129; }));
  EXPECT_FALSE(with(&PatchArrays::stored_vertex_counts, [](auto& v) { ++v[0]; }));
  EXPECT_FALSE(with(&PatchArrays::stored_vertex_counts, [](auto& v) { v.pop_back(); }));
  EXPECT_FALSE(with(&PatchArrays::field_counts, [](auto& v) { --v[0]; }));
  EXPECT_FALSE(with(&PatchArrays::field_counts, [&](auto& v) { v[0] = 1000; }));
  EXPECT_FALSE(with(&PatchArrays::quantization_steps, [](auto& v) { v[0] = 3; }))
      << "no power of two";
  EXPECT_FALSE(with(&PatchArrays::quantization_steps, [](auto& v) { v[0] = HUGE_VALF; }));
  EXPECT_FALSE(with(&PatchArrays::weights, [](auto& v) { v[0] = NAN; }));
  EXPECT_FALSE(with(&PatchArrays::weights, [](auto& v) { v.pop_back(); }));
  EXPECT_FALSE(with(&PatchArrays::quantized_values, [](auto& v) { v.push_back(0); }));
  EXPECT_FALSE(FieldPatches::from_arrays(made.arrays(), kVertices, std::vector<Index>{ranks[0]})
                   .has_value());
  EXPECT_FALSE(FieldPatches::from_arrays(made.arrays(), kVertices + 128, ranks).has_value());
}

TEST(FieldPatches, TellOfEachPatchAndEndWhereTheyAreTold) {
  const auto heads = smooth_heads(3);
  std::atomic<std::size_t> told{0};
  const FieldPatches patches = interpolate_fields(heads, kLevels, rows_of_grid(), 0.1,
                                                  [&](std::size_t more) { told += more; });
  EXPECT_EQ(told, patches.size());
  const auto stop = [](std::size_t) { throw std::runtime_error("enough"); };
  EXPECT_THROW(interpolate_fields(heads, kLevels, rows_of_grid(), 0.1, stop), std::runtime_error);
}

}  // namespace
}  // namespace crowdface
