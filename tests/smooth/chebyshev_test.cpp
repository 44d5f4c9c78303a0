// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/chebyshev.h"

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/smooth/iterate.h"

#include "support/expect_error.h"
#include "support/meshes.h"

namespace crowdface {
namespace {

using testing::grid_topology;
using testing::make_topology;
using testing::random_positions;

double value_at(const ChebyshevSeries& series, double x) {
  double previous = 1, now = x, sum = series[0];
  for (std::size_t k = 1; k < series.size(); ++k) {
    sum += series[k] * now;
    const double next = 2 * x * now - previous;
    previous = now;
    now = next;
  }
  return sum;
}

TEST(PowerSeries, IsThePowerOnTheWholeInterval) {
  for (const std::uint64_t level : {0U, 1U, 2U, 3U, 7U, 40U, 41U, 1000U, 20001U}) {
    const auto umbrella = power_series(OperatorKind::kUmbrella, level);
    const auto lazy = power_series(OperatorKind::kLazy, level);
    for (double x = -1; x <= 1; x += 1.0 / 64) {
      const double l = static_cast<double>(level);
      EXPECT_NEAR(value_at(umbrella, x), std::pow(x, l), 2e-10) << level << ' ' << x;
      EXPECT_NEAR(value_at(lazy, x), std::pow((1 + x) / 2, l), 2e-10) << level << ' ' << x;
    }
  }
}

TEST(PowerSeries, SumsToOneWithoutOverflowUpToAMillion) {
  for (const std::uint64_t level : {1U, 2U, 999U, 100000U, 1000000U, 999999U}) {
    for (const OperatorKind kind : {OperatorKind::kUmbrella, OperatorKind::kLazy}) {
      double sum = 0;
      for (const double a : power_series(kind, level)) {
        EXPECT_GE(a, 0);
        sum += a;
      }
      EXPECT_NEAR(sum, 1, 1e-13) << level;
    }
  }
}

TEST(PowerSeries, GrowsLikeTheRootOfTheLevel) {
  const double bound = std::sqrt(2 * 20000 * std::log(2 / kSeriesTolerance));
  EXPECT_LT(static_cast<double>(power_series(OperatorKind::kUmbrella, 20000).size()), bound);
  EXPECT_LT(static_cast<double>(power_series(OperatorKind::kLazy, 20000).size()),
            bound / std::sqrt(2) + 1);
}

TEST(PowerSeries, OfTheUmbrellaHasOneParity) {
  const auto odd = power_series(OperatorKind::kUmbrella, 101);
  for (std::size_t k = 0; k < odd.size(); k += 2) EXPECT_EQ(odd[k], 0);
}

/// Meshes with rims, several components, an isolated vertex, triangles and n-gons.
Topology mixed_topology() {
  Topology topology = grid_topology(13, 9);  // 140 vertices
  const auto add = [&](std::vector<std::uint32_t> face) {
    for (std::uint32_t& vertex : face) vertex += 140;
    topology.corner_vertices.insert(topology.corner_vertices.end(), face.begin(), face.end());
    topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
  };
  add({0, 3, 2, 1});  // a closed cube
  add({4, 5, 6, 7});
  add({0, 1, 5, 4});
  add({2, 3, 7, 6});
  add({1, 2, 6, 5});
  add({0, 4, 7, 3});
  add({8, 9, 10});  // an open patch of a triangle and a pentagon
  add({10, 9, 11, 12, 13});
  topology.vertex_count = 140 + 14 + 1;
  return topology;
}

using Case = std::tuple<Boundary, OperatorKind>;
class Filter : public ::testing::TestWithParam<Case> {
 protected:
  SmoothingOperator smoothing_{build_adjacency(mixed_topology()), std::get<0>(GetParam()),
                               std::get<1>(GetParam())};
  Positions positions_ = random_positions(155, 3);
};

TEST_P(Filter, EqualsIteration) {
  for (const std::uint64_t level : {0U, 1U, 2U, 3U, 10U, 37U, 500U, 501U}) {
    const double difference =
        (smooth(smoothing_, positions_, level) - iterate(smoothing_, positions_, level))
            .cwiseAbs()
            .maxCoeff();
    EXPECT_LT(difference, 1e-9) << level;
  }
}

TEST_P(Filter, KeepsConstantsAndWhatDoesNotMove) {
  const Positions ones = Positions::Ones(155, 3);
  EXPECT_LT((smooth(smoothing_, ones, 300) - ones).cwiseAbs().maxCoeff(), 1e-13);
  const Positions result = smooth(smoothing_, positions_, 300);
  for (Index i = 0; i < 155; ++i) {
    if (!smoothing_.neighbours(i).empty()) continue;
    EXPECT_EQ(result.row(i), positions_.row(i)) << i;  // to the bit
  }
}

TEST_P(Filter, LevelZeroIsTheInputToTheBit) {
  EXPECT_EQ(smooth(smoothing_, positions_, 0), positions_);
}

TEST_P(Filter, IsLinearAndComposes) {
  const Positions other = random_positions(155, 4);
  const Positions sum = 2 * positions_ - 3 * other;
  const Positions expected =
      2 * smooth(smoothing_, positions_, 20) - 3 * smooth(smoothing_, other, 20);
  EXPECT_LT((smooth(smoothing_, sum, 20) - expected).cwiseAbs().maxCoeff(), 1e-12);
  const Positions twice = smooth(smoothing_, smooth(smoothing_, positions_, 20), 15);
  EXPECT_LT((smooth(smoothing_, positions_, 35) - twice).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_P(Filter, ManyColumnsAreTheSameAsOneHeadAtATime) {
  const std::vector<std::uint64_t> levels = {0, 5, 80, 33, 12, 7};
  Columns all(155, 18);
  std::vector<ChebyshevSeries> series;
  for (std::size_t g = 0; g < levels.size(); ++g) {
    all.middleCols<3>(3 * static_cast<Index>(g)) = random_positions(155, 10 + g);
    series.push_back(power_series(smoothing_.kind(), levels[g]));
  }
  const Columns together = filter_each(smoothing_, all, series);
  for (std::size_t g = 0; g < levels.size(); ++g) {
    const Index column = 3 * static_cast<Index>(g);
    EXPECT_EQ(together.middleCols<3>(column),
              smooth(smoothing_, all.middleCols<3>(column), levels[g]))
        << g;  // one face alone and a face in a crowd: the same bits
  }
}

TEST_P(Filter, SeveralLevelsComeFromOnePass) {
  const auto results =
      filter_many(smoothing_, positions_,
                  {power_series(smoothing_.kind(), 4), power_series(smoothing_.kind(), 90)});
  EXPECT_EQ(results[0], smooth(smoothing_, positions_, 4));
  EXPECT_EQ(results[1], smooth(smoothing_, positions_, 90));
}

INSTANTIATE_TEST_SUITE_P(AllOperators, Filter,
                         ::testing::Combine(::testing::Values(Boundary::kFixed, Boundary::kFree),
                                            ::testing::Values(OperatorKind::kUmbrella,
                                                              OperatorKind::kLazy)));

TEST(FilterBits, DoNotDependOnTheThreadCount) {
  const Topology topology = grid_topology(150, 120);  // several blocks of rows
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Positions positions = random_positions(topology.vertex_count, 5);
  const Positions many = smooth(smoothing, positions, 200);
  const ThreadLimit one(1);
  EXPECT_EQ(smooth(smoothing, positions, 200), many);
}

TEST(Smoothing, ObeysTheMaximumPrinciple) {
  const Topology topology = grid_topology(12, 12);
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Positions positions = random_positions(topology.vertex_count, 6);
  const Positions result = smooth(smoothing, positions, 5000);
  EXPECT_LE(result.maxCoeff(), positions.maxCoeff() + 1e-9);
  EXPECT_GE(result.minCoeff(), positions.minCoeff() - 1e-9);
}

TEST(Smoothing, LetsACheckerboardLiveUnlessLazy) {
  // On a closed quad strip the umbrella mean flips a checkerboard for ever; the lazy one ends it.
  const Topology torus = [] {
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t y = 0; y < 4; ++y) {
      for (std::uint32_t x = 0; x < 6; ++x) {
        const auto at = [](std::uint32_t i, std::uint32_t j) { return j % 4 * 6 + i % 6; };
        faces.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
      }
    }
    return make_topology(24, faces);
  }();
  Positions checkerboard(24, 3);
  for (Index i = 0; i < 24; ++i) checkerboard.row(i).setConstant((i % 6 + i / 6) % 2 == 0 ? 1 : -1);
  const Adjacency adjacency = build_adjacency(torus);
  const SmoothingOperator umbrella(adjacency, Boundary::kFixed, OperatorKind::kUmbrella);
  const SmoothingOperator lazy(adjacency, Boundary::kFixed, OperatorKind::kLazy);
  EXPECT_LT((smooth(umbrella, checkerboard, 1001) + checkerboard).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(smooth(lazy, checkerboard, 1).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(FilterInput, RefusesRowsOfAnotherMesh) {
  const SmoothingOperator smoothing(build_adjacency(grid_topology(2, 2)), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  testing::expect_error(ExitCode::kBadData, {"9 rows", "8 by 3"},
                        [&] { smooth(smoothing, Positions::Zero(8, 3), 1); });
  testing::expect_error(ExitCode::kBadData, {"9 rows", "10"},
                        [&] { iterate(smoothing, Columns::Zero(10, 3), 1); });
}

}  // namespace
}  // namespace crowdface
