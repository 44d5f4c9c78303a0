// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/parts/gap_section.h"

namespace crowdface {
namespace {

using Line = std::vector<std::array<double, 2>>;  // y, z

constexpr std::uint32_t kLong = 4;  // quads along x

/// Two sheets of quads along x, which a cut at x = 0 meets in two lines.
struct Sheets {
  Topology topology;
  Positions positions;
  std::vector<double> side;

  Sheets(const Line& low, const Line& high) {
    const auto points = static_cast<Index>(low.size() + high.size());
    positions.resize(points * (kLong + 1), 3);
    topology.vertex_count = positions.rows();
    add(low, -0.5);
    add(high, 0.5);
  }

  double clearance() const {
    const Adjacency adjacency = build_adjacency(topology);
    std::vector<std::uint32_t> all;
    for (Index v = 0; v < positions.rows(); ++v) all.push_back(static_cast<std::uint32_t>(v));
    GapSection place{{0.1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {}, {}};
    cut_profiles(adjacency, positions, all, side, 100, place);
    return Clearance(place, adjacency).gap(positions);
  }

 private:
  void add(const Line& line, double on_side) {
    const auto first = static_cast<std::uint32_t>(side.size());
    const auto count = static_cast<std::uint32_t>(line.size());
    for (std::uint32_t x = 0; x <= kLong; ++x) {
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t a = first + x * count + i;
        positions.row(a) << x - 2.0, line[i][0], line[i][1];
        side.push_back(on_side);
        if (x == kLong || i + 1 == count) continue;
        topology.add_face(std::array{a, a + count, a + count + 1, a + 1});
      }
    }
  }
};

/// A lip with a flat top from z = 0 to z = 1.
const Line kLower = {{-3, 0}, {0, 0}, {0, 1}, {-3, 1}};

// A lower lip was pushed down until it cleared the rim that hangs behind it, and the mouth stood
// open.
TEST(Clearance, OfARimThatHangsBehindTheLipIsThatInFrontOfIt) {
  EXPECT_NEAR(Sheets(kLower, {{3, -1}, {-0.5, -1}, {1.5, 1}, {3, 2}}).clearance(), 0.5, 1e-12);
}

TEST(Clearance, OfProfilesThatCrossIsNegative) {
  EXPECT_NEAR(Sheets(kLower, {{2, -1}, {-0.25, 0.5}, {2, 2}}).clearance(), -0.25, 1e-12);
  // The point of the roof lies between two points of the lip, and the lip's edge between two of the
  // roof.
  EXPECT_NEAR(Sheets(kLower, {{-1, -1}, {1, 1}}).clearance(), 0, 1e-12);
}

TEST(Clearance, WhereNothingIsAboveAnythingIsThatOfTheNearestEnds) {
  EXPECT_NEAR(Sheets({{0, 0}, {0, 1}}, {{2, 3}, {1, 4}}).clearance(), 2, 1e-12);
}

}  // namespace
}  // namespace crowdface
