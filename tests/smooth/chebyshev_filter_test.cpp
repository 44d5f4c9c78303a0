// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/chebyshev_filter.h"

#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/instruction_set.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/smooth/iterate.h"

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
  ChebyshevFilter filter_{smoothing_, positions_};
};

TEST_P(Filter, EqualsIteration) {
  for (const std::uint64_t level : {0U, 1U, 2U, 3U, 10U, 37U, 500U, 501U}) {
    const double difference =
        (smooth(filter_, positions_, level) - iterate(smoothing_, positions_, level))
            .cwiseAbs()
            .maxCoeff();
    EXPECT_LT(difference, 1e-9) << level;
  }
}

TEST_P(Filter, KeepsConstantsAndWhatDoesNotMove) {
  const Positions ones = Positions::Ones(155, 3);
  EXPECT_LT((smooth(filter_, ones, 300) - ones).cwiseAbs().maxCoeff(), 1e-13);
  const Positions result = smooth(filter_, positions_, 300);
  for (Index i = 0; i < 155; ++i) {
    if (!smoothing_.neighbours(i).empty()) continue;
    EXPECT_EQ(result.row(i), positions_.row(i)) << i;  // to the bit
  }
}

TEST_P(Filter, LevelZeroIsTheInputToTheBit) {
  EXPECT_EQ(smooth(filter_, positions_, 0), positions_);
}

TEST_P(Filter, IsLinearAndComposes) {
  const Positions other = random_positions(155, 4);
  const Positions sum = 2 * positions_ - 3 * other;
  const Positions expected = 2 * smooth(filter_, positions_, 20) - 3 * smooth(filter_, other, 20);
  EXPECT_LT((smooth(filter_, sum, 20) - expected).cwiseAbs().maxCoeff(), 1e-12);
  const Positions twice = smooth(filter_, smooth(filter_, positions_, 20), 15);
  EXPECT_LT((smooth(filter_, positions_, 35) - twice).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_P(Filter, SeveralHeadsAreTheSameAsOneAtATime) {
  const std::vector<std::uint64_t> levels = {0, 5, 80, 33, 12, 7};
  std::vector<Positions> heads;
  std::vector<FilterInput<double>> inputs;
  for (std::size_t g = 0; g < levels.size(); ++g) {
    heads.push_back(random_positions(155, 10 + g));
    inputs.push_back(
        {filter_.rows_of<double>(heads[g]), {power_series(filter_.kind(), levels[g])}});
  }
  const auto together = filter_.run<double>(inputs);
  for (std::size_t g = 0; g < levels.size(); ++g) {
    const Positions alone = smooth(filter_, heads[g], levels[g]);
    for (Index v = 0; v < alone.rows(); ++v) {
      const Row<double>& row = together[g][0][filter_.row_of_vertex()[static_cast<std::size_t>(v)]];
      for (Index c = 0; c < 3; ++c) {
        EXPECT_EQ(row.value[c], alone(v, c)) << g;  // one face alone and a face in a crowd
      }
    }
  }
}

TEST_P(Filter, SeveralLevelsComeFromOnePass) {
  const auto results = filter_many(
      filter_, positions_, {power_series(filter_.kind(), 4), power_series(filter_.kind(), 90)});
  EXPECT_EQ(results[0], smooth(filter_, positions_, 4));
  EXPECT_EQ(results[1], smooth(filter_, positions_, 90));
}

TEST_P(Filter, ReadsPositionsWhereTheyAre) {
  const std::vector<std::uint64_t> levels = {3, 20};
  Positions more(200, 3);
  more.middleRows(40, 155) = positions_;
  EXPECT_EQ(smooth(filter_, more.middleRows(40, 155), levels), smooth(filter_, positions_, levels));
  EXPECT_THROW(smooth(filter_, more, levels), BrokenPrecondition);
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
  const ChebyshevFilter filter(smoothing, positions);
  const Positions many = smooth(filter, positions, 200);
  const ThreadLimit one(1);
  EXPECT_EQ(smooth(filter, positions, 200), many);
}

TEST(FilterBits, DoNotDependOnTheInstructionSetOrTheTiles) {
  const Topology topology = grid_topology(150, 120);
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Positions positions = random_positions(topology.vertex_count, 5);
  Positions along_the_grid(topology.vertex_count, 3);  // makes other tiles than random places
  for (Index i = 0; i < along_the_grid.rows(); ++i) {
    along_the_grid.row(i) << static_cast<double>(i % 151), static_cast<double>(i / 151), 0;
  }
  const ChebyshevFilter random_tiles(smoothing, positions), tiles(smoothing, along_the_grid);
  const Positions expected = smooth(tiles, positions, 150);
  EXPECT_EQ(smooth(random_tiles, positions, 150), expected);
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    EXPECT_EQ(smooth(tiles, positions, 150), expected) << name;
  }
  use_instruction_set(instruction_sets().front());
  EXPECT_THROW(use_instruction_set("mmx"), UsageError);
}

TEST(FilterProbes, HoldEveryTermOfTheRecurrence) {
  const Topology topology = grid_topology(150, 120);
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Positions positions = random_positions(topology.vertex_count, 5);
  const ChebyshevFilter filter(smoothing, positions);
  const FilterInput<double> input = {filter.rows_of<double>(positions),
                                     {power_series(filter.kind(), 100)}};
  RecordedTerms probes{{0, 77, 9000, 18270}, {}};
  filter.run<double>({&input, 1}, &probes);
  const ChebyshevSeries series = power_series(filter.kind(), 57);  // a level nobody asked for
  const Positions expected = iterate(smoothing, positions, 57);
  for (Index p = 0; p < 4; ++p) {
    Eigen::RowVector3d level = Eigen::RowVector3d::Zero();
    for (Index k = 0; k < std::min<Index>(probes.terms.rows(), static_cast<Index>(series.size()));
         ++k) {
      level += series[static_cast<std::size_t>(k)] * probes.terms.block<1, 3>(k, 3 * p);
    }
    const Index vertex = probes.vertices[static_cast<std::size_t>(p)];
    EXPECT_LT((level - expected.row(vertex)).norm(), 1e-9);
  }
}

TEST(Tiles, HoldEveryRingTheyNeed) {
  const Topology topology = mixed_topology();
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Tiling tiling = cut_into_tiles(smoothing, random_positions(155, 8), 20, 3);
  ASSERT_EQ(tiling.tiles.size(), 8U);
  std::uint32_t next = 0;
  for (const Tile& tile : tiling.tiles) {
    EXPECT_EQ(tile.first_row, next) << "every row in one tile";
    next += tile.row_count;
    const auto vertex_of = [&](std::uint32_t local) {
      return tiling.vertex_of_row[local < tile.row_count ? tile.first_row + local
                                                         : tile.halo[local - tile.row_count]];
    };
    std::set<std::uint32_t> reached;  // the rows that two more steps can still be computed on
    for (std::uint32_t r = 0; r < tile.row_count; ++r)
      reached.insert(tiling.vertex_of_row[tile.first_row + r]);
    for (std::size_t ring = 0; ring < 3; ++ring) {
      std::set<std::uint32_t> computed;
      for (std::size_t r = 0; r < tile.run_count_up_to_ring[ring]; ++r) {
        const ValenceRun& run = tile.runs[r];
        for (std::uint32_t i = 0; i < run.row_count; ++i) {
          const std::uint32_t vertex = vertex_of(run.first_row + i);
          computed.insert(vertex);
          const auto expected = smoothing.neighbours(vertex);
          ASSERT_EQ(run.valence, expected.size());
          for (std::uint32_t n = 0; n < run.valence; ++n) {
            EXPECT_EQ(vertex_of(tile.neighbours[run.first_neighbour + i * run.valence + n]),
                      expected[n]);
          }
        }
      }
      std::set<std::uint32_t> wider = reached;
      for (const std::uint32_t v : reached) {
        if (!smoothing.neighbours(v).empty()) {
          EXPECT_EQ(computed.count(v), 1U) << "ring " << ring;
        }
        for (const std::uint32_t n : smoothing.neighbours(v)) wider.insert(n);
      }
      reached = wider;
    }
  }
  EXPECT_EQ(next, 155U);
}

TEST(Smoothing, ObeysTheMaximumPrinciple) {
  const Topology topology = grid_topology(12, 12);
  const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const Positions positions = random_positions(topology.vertex_count, 6);
  const Positions result = smooth(ChebyshevFilter(smoothing, positions), positions, 5000);
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
  EXPECT_LT((smooth(ChebyshevFilter(umbrella, checkerboard), checkerboard, 1001) + checkerboard)
                .cwiseAbs()
                .maxCoeff(),
            1e-9);
  EXPECT_LT(smooth(ChebyshevFilter(lazy, checkerboard), checkerboard, 1).cwiseAbs().maxCoeff(),
            1e-15);
}

TEST(FilterInput, RefusesRowsOfAnotherMesh) {
  const SmoothingOperator smoothing(build_adjacency(grid_topology(2, 2)), Boundary::kFixed,
                                    OperatorKind::kUmbrella);
  const ChebyshevFilter filter(smoothing, Positions::Zero(9, 3));
  EXPECT_THROW(smooth(filter, Positions::Zero(8, 3), 1), BrokenPrecondition);
  EXPECT_THROW(ChebyshevFilter(smoothing, Positions::Zero(8, 3)), BrokenPrecondition);
  EXPECT_THROW(iterate(smoothing, Columns::Zero(10, 3), 1), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
