// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/match_rims.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/mesh/all_columns.h"

#include "support/expect_error.h"
#include "tube.h"

namespace crowdface {
namespace {

using testing::expect_error;
using testing::Tube;

constexpr double kReachMm = 60;

std::vector<Rim> rims_of(const Topology& topology) {
  return find_open_rims(topology, build_adjacency(topology));
}

TEST(OpenRims, AreTheLoopsOfAMesh) {
  const Tube tube;
  const std::vector<Rim> rims = rims_of(tube.topology());
  ASSERT_EQ(rims.size(), 2U);
  Rim low = rims[0];
  std::ranges::sort(low);
  EXPECT_EQ(low, tube.rim());
  EXPECT_EQ(rims[1].size(), 24U);
  EXPECT_TRUE(rims_of(testing::cube_topology()).empty());
  EXPECT_EQ(rims_of(testing::grid_topology(3, 2)).front().size(), 10U);
}

// Two sheets that share one corner: the walk around them would run from one onto the other.
TEST(OpenRims, ThatTouchAreLeftOut) {
  const Topology sheets = testing::make_topology(7, {{0, 1, 2, 3}, {2, 4, 5, 6}});
  EXPECT_TRUE(rims_of(sheets).empty());
}

TEST(RimThrough, OrdersVerticesAlongTheirEdges) {
  const Tube tube;
  const Adjacency adjacency = build_adjacency(tube.topology());
  Rim middle;
  for (std::uint32_t i = 0; i < tube.around; ++i) middle.push_back(5 * tube.around + (7 * i) % 24);
  const Rim rim = rim_through(middle, adjacency);
  ASSERT_EQ(rim.size(), middle.size());
  for (std::size_t i = 0; i < rim.size(); ++i) {
    EXPECT_TRUE(std::ranges::count(adjacency.items_of(rim[i]), rim[(i + 1) % rim.size()]) == 1);
  }
  middle.pop_back();
  EXPECT_TRUE(rim_through(middle, adjacency).empty());
  middle = tube.rim();
  const Rim other = {48 + 0, 48 + 1};
  middle.insert(middle.end(), other.begin(), other.end());
  EXPECT_TRUE(rim_through(middle, adjacency).empty());
}

TEST(LowestRim, IsTheLowestLongOne) {
  const Tube tube;
  const std::vector<Rim> rims = rims_of(tube.topology());
  EXPECT_EQ(lowest_rim(rims, tube.positions(), {0, 1, 0}, 1), rims[0]);
  EXPECT_EQ(lowest_rim(rims, tube.positions(), {0, -1, 0}, 1), rims[1]);
  expect_error(ExitCode::kBadData, {"two open rims", "24 and 24"}, [&] {
    lowest_rim(rims, tube.positions(), {1, 0, 0}, 1);
  });
  expect_error(ExitCode::kBadData, {"no open rim", "neck.rim"}, [&] {
    lowest_rim({}, tube.positions(), {0, 1, 0}, 1);
  });
}

/// A head's neck is a tube that begins at y = 0. The body is the same tube, turned over: its ring at
/// y = 0 is its last, in the order of the head's rim.
class MatchingRim : public ::testing::Test {
 protected:
  MatchingRim() : head_(tube_.positions()(tube_.rim(), kAllColumns)), body_(tube_.positions()) {
    for (Index v = 0; v < body_.rows(); ++v) body_(v, 1) = -body_(v, 1);
  }
  Rim find() const { return find_matching_rim(head_, rims_of(topology_), body_, kReachMm); }
  void expect_refused(const std::vector<std::string>& phrases) const {
    for (const std::string& phrase : phrases) {
      expect_error(ExitCode::kBadData, {"of 24 vertices", phrase}, [&] { find(); });
    }
  }
  /// Moves the body's vertices. \param move  maps each position to the new one
  template <class Move>
  void move(const Move& move) {
    for (Index v = 0; v < body_.rows(); ++v) {
      const Eigen::Vector3d moved = move(Eigen::Vector3d(body_.row(v).transpose()));
      body_.row(v) = moved.transpose();
    }
  }

  Tube tube_;
  Positions head_, body_;
  Topology topology_ = tube_.topology();
};

TEST_F(MatchingRim, IsTheNearestOfEqualLength) {
  const Rim rim = find();
  EXPECT_EQ(rim, tube_.rim());
  EXPECT_EQ(body_(rim, kAllColumns), head_);
}

// The vertices of a body have their own numbers, and its polygons may be turned.
TEST_F(MatchingRim, DoesNotDependOnNumbersOrDirection) {
  const auto count = static_cast<std::uint32_t>(body_.rows());
  const auto renumbered = [&](std::uint32_t v) { return (7 * v + 11) % count; };
  Positions body(body_.rows(), 3);
  for (std::uint32_t v = 0; v < count; ++v) body.row(renumbered(v)) = body_.row(v);
  for (std::uint32_t& v : topology_.corner_vertices) v = renumbered(v);
  for (Index f = 0; f < topology_.face_count(); ++f) {
    const auto [begin, end] = topology_.corners(f);
    std::reverse(topology_.corner_vertices.begin() + begin,
                 topology_.corner_vertices.begin() + end);
  }
  body_ = body;
  EXPECT_EQ(body_(find(), kAllColumns), head_);
}

TEST_F(MatchingRim, MayDifferAsNecksOfPeopleDo) {
  move([](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(1.2 * p.x() + 9, p.y() - 14, 0.95 * p.z());
  });
  EXPECT_EQ(find(), tube_.rim());
}

TEST_F(MatchingRim, ScaledIsRefused) {
  move([](const Eigen::Vector3d& p) { return Eigen::Vector3d(2.54 * p); });
  expect_refused({"2.54 times as large"});
}

TEST_F(MatchingRim, ElsewhereIsRefused) {
  move([](const Eigen::Vector3d& p) { return Eigen::Vector3d(p.x(), p.y() - 250, p.z()); });
  expect_refused({"elsewhere, 250.0 mm off"});
}

TEST_F(MatchingRim, TurnedIsRefused) {
  for (const double degrees : {20.0, 45.0, 90.0, 180.0}) {
    const Positions before = body_;
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitY());
    move([&](const Eigen::Vector3d& p) { return turn * p; });
    expect_refused({concat("turned by ", degrees, " degrees"), " mm"});
    body_ = before;
  }
}

// A rim with equal left and right sides fits upside down, too.
TEST_F(MatchingRim, IsNotTakenForOneUpsideDown) {
  tube_.skew = 0;
  head_ = tube_.positions()(tube_.rim(), kAllColumns);
  for (const double degrees : {9.0, 15.0}) {
    body_ = tube_.positions();
    for (Index v = 0; v < body_.rows(); ++v) body_(v, 1) = -body_(v, 1);
    // Of the directions, the wrong one fits a little better.
    for (Index v = 0; v < body_.rows(); ++v) body_(v, 0) += 0.002 * body_(v, 2);
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitY());
    move([&](const Eigen::Vector3d& p) { return turn * p; });
    if (degrees < 12) {
      EXPECT_EQ(find(), tube_.rim());
    } else {
      expect_refused({"turned by 15 degrees"});
    }
  }
}

// A rotation by more than half the distance of two vertices: the nearest vertices are others.
TEST_F(MatchingRim, KeepsItsOrderIfItIsTurnedALittle) {
  const Eigen::AngleAxisd turn(10 * std::numbers::pi / 180, Eigen::Vector3d(0.28, 0.96, 0));
  move([&](const Eigen::Vector3d& p) { return turn * p; });
  EXPECT_EQ(find(), tube_.rim());
}

TEST_F(MatchingRim, MayHaveAGivenOrder) {
  Rim rim = tube_.rim();
  EXPECT_EQ(find_matching_rim(head_, {rim}, body_, kReachMm, RimOrder::kGiven), rim);
  std::rotate(rim.begin(), rim.begin() + 1, rim.end());
  expect_error(ExitCode::kBadData, {"turned by"},
               [&] { find_matching_rim(head_, {rim}, body_, kReachMm, RimOrder::kGiven); });
}

TEST_F(MatchingRim, InAnotherOrderIsRefused) {
  // The ring's polygons connect every fifth vertex.
  Positions body = body_;
  for (std::uint32_t i = 0; i < tube_.around; ++i) body.row(i) = body_.row((5 * i) % tube_.around);
  body_ = body;
  expect_refused({"in another order", " mm"});
}

TEST_F(MatchingRim, OfAnotherLengthIsRefused) {
  Tube coarse = tube_;
  coarse.around = 22;
  topology_ = coarse.topology();
  body_ = coarse.positions();
  expect_refused({"rims of 22 vertices, 0.0 mm off; 22 vertices, 120.0 mm off"});
  // The lower end has the wanted number of vertices, but is elsewhere and larger.
  const Tube wide{.radius = 150, .height = 40, .bottom = -400};
  const auto first = static_cast<std::uint32_t>(body_.rows());
  body_.conservativeResize(first + wide.positions().rows(), 3);
  body_.bottomRows(wide.positions().rows()) = wide.positions();
  const Topology lower = wide.topology();
  for (Index f = 0; f < lower.face_count(); ++f) {
    std::vector<std::uint32_t> face(lower.face(f).begin(), lower.face(f).end());
    for (std::uint32_t& v : face) v += first;
    topology_.add_face(face);
  }
  topology_.vertex_count = body_.rows();
  expect_refused({"rims of 22 vertices, 0.0 mm off; 22 vertices, 120.0 mm off; 24 vertices, 360"});
}

TEST_F(MatchingRim, OpenTwiceIsRefused) {
  const Positions once = body_;
  body_.resize(2 * once.rows(), 3);
  body_ << once, once;
  const Topology other = topology_;
  for (Index f = 0; f < other.face_count(); ++f) {
    std::vector<std::uint32_t> face(other.face(f).begin(), other.face(f).end());
    for (std::uint32_t& v : face) v += static_cast<std::uint32_t>(once.rows());
    topology_.add_face(face);
  }
  topology_.vertex_count = body_.rows();
  expect_refused({"2 that fit, 0.0 mm and 0.0 mm off"});
}

TEST_F(MatchingRim, IsMissingInAClosedBody) {
  topology_ = testing::cube_topology();
  body_ = testing::cube_positions();
  expect_refused({"found none"});
}

}  // namespace
}  // namespace crowdface
