// SPDX-License-Identifier: Apache-2.0
// What must hold on each synthetic head: no folded, turned or vanishing quads, even edges, lids and
// lips apart, no piece of skin through another.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/normals.h"
#include "head_models/synth/layout.h"
#include "head_models/synth/mean_head.h"
#include "head_models/synth/synthetic_head.h"

#include "support/meshes.h"
#include "support/self_crossing.h"

namespace crowdface {
namespace {

using Eigen::Vector3d;
using testing::find_self_crossings;

constexpr std::uint64_t kSeed = 9, kHeads = 200;

class Plausible : public ::testing::Test {
 protected:
  static const SyntheticHeads& heads() {
    static const SyntheticHeads instance(5000);
    return instance;
  }
  /// All two hundred, made once.
  static const std::vector<Positions>& all() {
    static const std::vector<Positions> instance = [] {
      std::vector<Positions> out(kHeads);
      for (std::uint64_t h = 0; h < kHeads; ++h) out[h] = heads().positions(kSeed, h);
      return out;
    }();
    return instance;
  }
  const synth::Layout layout_ = synth::make_layout(5000);
  const Topology& topology_ = heads().topology();
};

TEST_F(Plausible, NoQuadIsFlippedOrVanishes) {
  for (std::uint64_t h = 0; h < kHeads; ++h) {
    const Positions& head = all()[h];
    ASSERT_TRUE(head.allFinite());
    for (Index f = 0; f < topology_.face_count(); ++f) {
      const auto face = topology_.face(f);
      const Vector3d area = face_area_vector(topology_, f, head) / 2;
      ASSERT_GT(area.norm(), 1e-4) << "head " << h << " face " << f;
      for (std::size_t k = 0; k < 4; ++k) {
        const Vector3d at = head.row(face[k]), next = head.row(face[(k + 1) % 4]);
        const Vector3d last = head.row(face[(k + 3) % 4]);
        ASSERT_GT((next - at).cross(last - at).dot(area), 0) << "head " << h << " face " << f;
      }
    }
  }
}

TEST_F(Plausible, NoQuadIsTurnedAwayFromItsPlaceOnTheAverageHead) {
  Positions mean(topology_.vertex_count, 3);
  for (Index i = 0; i < mean.rows(); ++i) {
    mean.row(i) = synth::mean_skin(layout_.lattice_points[static_cast<std::size_t>(i)]).position;
  }
  for (std::uint64_t h = 0; h < kHeads; ++h) {
    for (Index f = 0; f < topology_.face_count(); ++f) {
      const Vector3d own = face_area_vector(topology_, f, all()[h]);
      ASSERT_GT(own.dot(face_area_vector(topology_, f, mean)), 0) << "head " << h << " face " << f;
    }
  }
}

TEST_F(Plausible, EdgesAreOfLikeLength) {
  const Adjacency adjacency = build_adjacency(topology_);
  for (std::uint64_t h = 0; h < kHeads; h += 4) {
    const Positions& head = all()[h];
    std::vector<double> lengths;
    for (Index i = 0; i < head.rows(); ++i) {
      for (const auto j : adjacency.items_of(i))
        lengths.push_back((head.row(i) - head.row(j)).norm());
    }
    std::ranges::sort(lengths);
    const double median = lengths[lengths.size() / 2];
    EXPECT_LT(lengths.back(), 6 * median) << "head " << h;
    EXPECT_GT(lengths.front(), median / 50) << "head " << h;
  }
}

TEST_F(Plausible, LidsAndLipsStayApart) {
  // Above and below at the same place of an opening's edge: a on the upper side, 5 − a below.
  std::map<std::array<double, 3>, std::array<Index, 2>> pairs;
  for (Index i = 0; i < topology_.vertex_count; ++i) {
    const synth::LatticePoint& a = layout_.lattice_points[static_cast<std::size_t>(i)];
    if (a.b != 1 || (a.patch != synth::SkinPatch::kEye && a.patch != synth::SkinPatch::kMouth))
      continue;
    const auto patch = static_cast<double>(a.patch);
    const auto across = [](double x) { return std::floor(1e6 * x + 0.5); };
    if (a.a > 3) pairs[{patch, a.side, across(4 - a.a)}][0] = i + 1;
    if (a.a > 1 && a.a < 2) pairs[{patch, a.side, across(a.a - 1)}][1] = i + 1;
  }
  int checked = 0;
  for (std::uint64_t h = 0; h < kHeads; ++h) {
    for (const auto& [key, pair] : pairs) {
      if (pair[0] == 0 || pair[1] == 0) continue;
      ++checked;
      EXPECT_GT(all()[h](pair[0] - 1, 1), all()[h](pair[1] - 1, 1) + 0.005) << "head " << h;
    }
  }
  EXPECT_GT(checked, 2000);
}

TEST(SelfCrossing, FindsWhatCrossesAndNothingElse) {
  const Topology two = testing::make_topology(8, {{0, 1, 2, 3}, {4, 5, 6, 7}});
  Positions p(8, 3);
  p << 0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 1, 0.8, -1, 3, 0.8, -1, 3, 0.8, 1, 1, 0.8, 1;
  EXPECT_EQ(find_self_crossings(two, p, 0.7).size(), 1U);
  p.bottomRows(4).col(0).array() += 1.5;
  EXPECT_TRUE(find_self_crossings(two, p, 0.7).empty());
  EXPECT_TRUE(find_self_crossings(testing::cube_topology(), testing::cube_positions(), 1).empty());
}

TEST_F(Plausible, NoSkinCutsThroughItself) {
  const std::vector<Positions>& heads = all();
  std::vector<std::size_t> crossings(heads.size());
  parallel_for_each(static_cast<std::ptrdiff_t>(heads.size()), [&](std::ptrdiff_t h) {
    const auto at = static_cast<std::size_t>(h);
    crossings[at] = find_self_crossings(topology_, heads[at], 0.6).size();
  });
  for (std::size_t h = 0; h < heads.size(); ++h) EXPECT_EQ(crossings[h], 0U) << "head " << h;
}

}  // namespace
}  // namespace crowdface
