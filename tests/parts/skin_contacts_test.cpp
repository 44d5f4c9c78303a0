// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/skin_contacts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "crowdface/parts/facing_skin.h"
#include "head_models/synth/synthetic_head.h"

#include "parts/scene.h"
#include "parts/slotted_roller.h"

namespace crowdface {
namespace {

using testing::slotted_roller;

std::vector<std::uint32_t> all_of(const Topology& topology) {
  std::vector<std::uint32_t> all(static_cast<std::size_t>(topology.vertex_count));
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

HeadSet heads_with_gaps(const std::vector<double>& gaps, double step = 0.5) {
  HeadSet faces;
  for (const double gap : gaps) {
    Mesh mesh = slotted_roller(gap, step);
    faces.topology = mesh.topology;
    faces.heads.push_back({"head", std::move(mesh.positions)});
  }
  return faces;
}

SkinContacts contacts_of(const HeadSet& head_set) {
  return {head_set, build_adjacency(head_set.topology), all_of(head_set.topology)};
}

std::vector<SkinContacts::Range> everywhere(const SkinContacts& contacts, double least,
                                            double most) {
  return std::vector<SkinContacts::Range>(contacts.size(), {least, most});
}

TEST(FacingSkin, IsWhatLooksAtEachOtherThroughANarrowGap) {
  Mesh mesh = slotted_roller(0.1);
  const auto groups = [&] {
    return find_facing_skin(mesh.topology, build_adjacency(mesh.topology), mesh.positions,
                            all_of(mesh.topology));
  };
  const std::vector<FacingGroup> found = groups();
  ASSERT_EQ(found.size(), 1U);
  for (const FacingPair& pair : found.front()) {
    EXPECT_NEAR(std::abs(pair.up.y()), 1, 1e-9);
    EXPECT_EQ(pair.up.y() > 0,
              mesh.positions(pair.high_vertex, 1) > mesh.positions(pair.low_vertex, 1));
  }
  mesh.positions.col(0) *= -1;  // now the faces look inward
  EXPECT_EQ(groups().size(), 1U);
  mesh = slotted_roller(1);
  EXPECT_TRUE(groups().empty()) << "too wide to be a contact";
}

TEST(FacingSkin, IsNotTheTwoSidesOfThinFlesh) {
  const Mesh plate = testing::Shapes().ball({0, 0, 0}, 5, 40).mesh();
  Positions flat = plate.positions;
  flat.col(2) *= 0.02;
  EXPECT_TRUE(find_facing_skin(plate.topology, build_adjacency(plate.topology), flat,
                               all_of(plate.topology))
                  .empty());
}

TEST(SkinContacts, AreAsWideAsTheyWereMade) {
  const HeadSet faces = heads_with_gaps({0.04, 0.08, 0.12});
  const SkinContacts contacts = contacts_of(faces);
  ASSERT_GT(contacts.size(), 20U);
  for (const auto& [head, gap] : {std::pair{0, 0.04}, {1, 0.08}, {2, 0.12}}) {
    for (const double found : contacts.head_gaps(head)) EXPECT_NEAR(found, gap, 1e-9);
  }
  EXPECT_NEAR(contacts.max_gap_excess(slotted_roller(0.5).positions), 0.38, 1e-9);
  EXPECT_EQ(contacts.max_gap_excess(slotted_roller(0.1).positions), 0);
}

TEST(SkinContacts, AreBroughtIntoTheirRanges) {
  const HeadSet faces = heads_with_gaps({0.04, 0.12});
  const SkinContacts contacts = contacts_of(faces);
  for (const auto& [made, wanted] : {std::pair{0.5, 0.12}, {-0.2, 0.04}}) {
    Positions face = slotted_roller(made).positions;
    const Positions before = face;
    contacts.fit_gaps(everywhere(contacts, 0.04, 0.12), face);
    for (const double gap : contacts.gaps(face)) EXPECT_NEAR(gap, wanted, 1e-3);
    for (Index v = 0; v < face.rows(); ++v) {
      if (before(v, 2) >= -1) continue;
      EXPECT_TRUE(face.row(v) == before.row(v)) << "the back stays";
    }
    EXPECT_LT((face - before).rowwise().norm().maxCoeff(), 0.4);
  }
}

// Skin that moves far changes which points lie at one depth: some of the gap was left.
TEST(SkinContacts, AreBroughtIntoTheirRangesFromFarWhereWallsAreWaves) {
  const auto waves = [](double gap) {
    Positions points = slotted_roller(gap).positions;
    for (Index v = 0; v < points.rows(); ++v) {
      points(v, 1) += 0.3 * std::sin(2 * points(v, 2) + 0.75 * points(v, 0));
    }
    return points;
  };
  HeadSet faces = heads_with_gaps({0.04, 0.12});
  faces.heads[0].positions = waves(0.04);
  faces.heads[1].positions = waves(0.12);
  const SkinContacts contacts = contacts_of(faces);
  ASSERT_GT(contacts.size(), 20U);
  std::vector<SkinContacts::Range> ranges;
  for (std::size_t p = 0; p < contacts.size(); ++p) {
    const auto [least, most] = std::minmax(contacts.head_gaps(0)[p], contacts.head_gaps(1)[p]);
    ranges.push_back({least, most});
  }
  Positions face = waves(1);
  contacts.fit_gaps(ranges, face);
  EXPECT_LT(contacts.max_gap_excess(face), 2e-3);
}

// Places closer than skin bends were pulled apart and together by turns, until lips were an S.
TEST(SkinContacts, DoNotPullSkinApartAndTogetherWhereNeighboursDiffer) {
  constexpr double kFine = 0.12;
  const HeadSet faces = heads_with_gaps({0.04, 0.12}, kFine);
  const SkinContacts contacts = contacts_of(faces);
  ASSERT_GT(contacts.size(), 9U);
  std::vector<std::size_t> along(contacts.size());
  std::iota(along.begin(), along.end(), 0U);
  std::sort(along.begin(), along.end(), [&](std::size_t a, std::size_t b) {
    return contacts.section(a).middle.x() < contacts.section(b).middle.x();
  });
  std::vector<SkinContacts::Range> ranges(contacts.size());
  for (std::size_t i = 0; i < along.size(); ++i) {
    const double gap = i % 2 == 0 ? 0.2 : 0;
    ranges[along[i]] = {gap, gap + 0.005};
  }
  Positions face = slotted_roller(0.5, kFine).positions;
  const Positions before = face;
  contacts.fit_gaps(ranges, face);
  EXPECT_LT((face - before).rowwise().norm().maxCoeff(), 0.27)
      << "half of what is missing, or little more";
  const std::vector<double> gaps = contacts.gaps(face);
  for (std::size_t p = 0; p < gaps.size(); ++p) {
    EXPECT_GT(gaps[p], ranges[p].min - 0.2);
    EXPECT_LT(gaps[p], ranges[p].max + 0.2);
  }
}

TEST(SkinContacts, AreLeftAloneToTheBitWhereAllIsWell) {
  const HeadSet faces = heads_with_gaps({0.04, 0.12});
  const SkinContacts contacts = contacts_of(faces);
  Positions face = slotted_roller(0.07).positions;
  contacts.fit_gaps(everywhere(contacts, 0.04, 0.12), face);
  EXPECT_TRUE(face == slotted_roller(0.07).positions);
}

TEST(SkinContacts, OfSyntheticHeadsAreTheirLipsAtAnyResolution) {
  for (const Index vertices : {5000, 20000, 150000}) {
    const SyntheticHeads synthetic(vertices, SyntheticHeads::Parts::kSkin);
    HeadSet faces;
    faces.topology = synthetic.topology();
    for (std::uint64_t h = 0; h < 4; ++h) faces.heads.push_back({"h", synthetic.positions(1, h)});
    const SkinContacts contacts = contacts_of(faces);
    std::size_t lips = 0;
    for (std::size_t p = 0; p < contacts.size(); ++p) {
      const Eigen::Vector3d& middle = contacts.section(p).middle;
      if (middle.z() > 5 && middle.y() < -5) ++lips;
    }
    // Of 5,000 vertices a mouth has no more than six edges across.
    EXPECT_GE(lips, vertices == 5000 ? 6U : 12U) << vertices;
    EXPECT_LE(lips, 24U) << vertices;
  }
}

}  // namespace
}  // namespace crowdface
