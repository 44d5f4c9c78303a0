// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/hair_cards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/hash.h"
#include "head_models/synth/hair_form.h"
#include "head_models/synth/hair_picture.h"
#include "head_models/synth/sculpture.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

const HairCut& cut_named(std::string_view name) {
  return *std::ranges::find_if(hair_cuts(), [&](const HairCut& cut) { return cut.name == name; });
}

/// Made once for all tests.
const Mesh& cards_of(const HairCut& cut) {
  static std::map<std::string_view, Mesh> known;
  const auto [found, is_new] = known.try_emplace(cut.name);
  if (is_new) {
    HairMesh cards;
    add_hair_cards(cut, cards);
    found->second = std::move(cards).to_mesh();
  }
  return found->second;
}

TEST(HairCards, AreTheSameOnEveryMachine) {
  const Mesh& bob = cards_of(cut_named("bob"));
  const auto values = static_cast<std::size_t>(bob.positions.size());
  EXPECT_EQ(Hasher().add_array(std::span(bob.positions.data(), values)).digest().hex(),
            "33431daf8fdc2fb677b65c63e03cd2f4");
  const std::vector<std::uint8_t> picture = hair_picture(64, {0.5, 0.4, 0.3}, true);
  EXPECT_EQ(Hasher().add_array(std::span(picture)).digest().hex(),
            "198d060c3a5d17eb58ee63cca2f51416");
}

// Single locks stood off the others beside the neck.
TEST(HairCards, HangTogetherBesideTheNeck) {
  for (const char* name : {"long", "waves"}) {
    std::vector<double> sideways;
    for (const auto& p : cards_of(cut_named(name)).positions.rowwise()) {
      if (p.y() < -8) sideways.push_back(std::abs(p.x()));
    }
    ASSERT_GT(sideways.size(), 100U) << name;
    std::ranges::sort(sideways);
    EXPECT_LT(sideways.back() - sideways[sideways.size() * 95 / 100], 1) << name << ", in cm";
  }
}

TEST(HairCards, RecedeMostBesideTheForehead) {
  const auto lost_at = [](const Vector3d& p) {
    return distance_inside_hair(cut_named("swept_back"), p) -
           distance_inside_hair(cut_named("receding_back"), p);
  };
  EXPECT_GT(lost_at({0, 8, 8}), 1);
  EXPECT_GT(lost_at({3, 8, 6}), lost_at({0, 8, 8})) << "the hairline has corners";
  EXPECT_EQ(lost_at({0, 8, -8}), 0) << "the back of the head";
}

TEST(HairCards, BothSexesHaveStraightAndCurlyCuts) {
  for (const bool female : {true, false}) {
    for (const bool curly : {true, false}) {
      EXPECT_TRUE(std::ranges::any_of(
          hair_cuts(),
          [&](const HairCut& cut) { return cut.is_for_women == female && cut.is_curly == curly; }))
          << female << curly;
    }
  }
}

TEST(HairCards, LeaveEyesNoseAndMouthFree) {
  for (const HairCut& cut : hair_cuts()) {
    const Mesh& hair = cards_of(cut);
    for (Index v = 0; v < hair.positions.rows(); ++v) {
      const Vector3d p = hair.positions.row(v);
      const bool in_face = p.z() > 5 && std::abs(p.x()) < 3.5 && p.y() < 1.5;
      ASSERT_FALSE(in_face) << cut.name << " at " << p.transpose();
    }
  }
}

TEST(HairCards, StayOutsideTheHeadButForTheirRoots) {
  for (const HairCut& cut : hair_cuts()) {
    const Mesh& hair = cards_of(cut);
    Index inside = 0;
    for (Index v = 0; v < hair.positions.rows(); ++v) {
      const Vector3d p = hair.positions.row(v);
      EXPECT_GT(skin_distance(p), -0.7) << cut.name << " at " << p.transpose();
      inside += skin_distance(p) < -0.05 ? 1 : 0;
    }
    EXPECT_LT(inside, hair.positions.rows() / 10) << cut.name;
  }
}

TEST(HairCards, EachCardShowsAStripFromRootsToTips) {
  const Mesh& hair = cards_of(cut_named("long"));
  ASSERT_EQ(hair.uvs.rows(), hair.positions.rows());
  EXPECT_EQ(hair.topology.vertex_count, hair.positions.rows());
  EXPECT_GT(hair.uvs.minCoeff(), 0);
  EXPECT_LT(hair.uvs.maxCoeff(), 1);
  for (Index f = 0; f < hair.topology.face_count(); ++f) {
    const auto face = hair.topology.face(f);
    ASSERT_EQ(face.size(), 4U);
    EXPECT_GT(hair.uvs(face[0], 1), hair.uvs(face[3], 1)) << "v falls from the root on";
    EXPECT_LT(std::abs(hair.uvs(face[0], 0) - hair.uvs(face[1], 0)), 0.25);
  }
}

/// No lock arches over the head: background showed below such loops at the crown.
TEST(HairCards, LieOnTheHeadAboveTheEars) {
  for (const HairCut& cut : hair_cuts()) {
    if (cut.layers > 1) continue;  // curls stand off in every direction
    const double most = 0.8 * cut.volume_factor + 0.9 + cut.wave_amplitude;
    const Mesh& hair = cards_of(cut);
    for (Index v = 0; v < hair.positions.rows(); ++v) {
      const Vector3d p = hair.positions.row(v);
      if (p.y() > 5) {
        ASSERT_LT(head_distance(p), most) << cut.name << " at " << p.transpose();
      }
    }
  }
}

TEST(HairCards, AFringeIsCutLevel) {
  const HairCut& cut = cut_named("fringe");
  const Mesh& hair = cards_of(cut);
  double lowest = 99;
  std::array<bool, 8> covered{};  // centimetres of the forehead
  for (Index v = 0; v < hair.positions.rows(); ++v) {
    const Vector3d p = hair.positions.row(v);
    if (p.z() < 5 || std::abs(p.x()) >= 4) continue;
    lowest = std::min(lowest, p.y());
    if (p.y() < cut.fringe_y + 0.5) covered[static_cast<std::size_t>(std::floor(p.x() + 4))] = true;
  }
  EXPECT_GT(lowest, cut.fringe_y - 0.6);
  EXPECT_THAT(covered, ::testing::Each(true)) << "it reaches its line everywhere";
}

TEST(HairCap, IsClosedInsideAndFraysAtItsEdge) {
  for (const HairCut& cut : hair_cuts()) {
    HairMesh below;
    add_hair_cap(cut, below);
    const Mesh cap = std::move(below).to_mesh();
    ASSERT_GT(cap.topology.face_count(), 100) << cut.name;
    EXPECT_GT(cap.uvs.col(0).minCoeff(), static_cast<double>(kCardStripCount) / kTextureStripCount);
    EXPECT_LT(cap.uvs.col(0).maxCoeff(), 1);
    for (Index v = 0; v < cap.positions.rows(); ++v) {
      const Vector3d p = cap.positions.row(v);
      ASSERT_GT(skin_distance(p), 0) << cut.name << " at " << p.transpose();
    }
    EXPECT_LT(cap.uvs.col(1).minCoeff(), 0.1) << cut.name;
    EXPECT_GT(cap.uvs.col(1).maxCoeff(), 0.5) << cut.name;
  }
  // Inside, what lies below the cards is closed. Towards the hairline it becomes sparse: a cap that
  // ended within a few millimetres looked like a wig.
  constexpr int kSize = 100, kClosed = 38;
  for (const bool curly : {false, true}) {
    const std::vector<std::uint8_t> picture = hair_picture(kSize, {0.3, 0.2, 0.1}, curly);
    double red = 0;
    const auto mean_cover = [&](int y) {
      double sum = 0;
      const int first = kSize * kCardStripCount / kTextureStripCount;
      for (int x = first; x < kSize; ++x)
        sum += picture[4 * static_cast<std::size_t>(y * kSize + x) + 3];
      return sum / (kSize - first) / 255;
    };
    for (int y = kClosed; y + 8 < kSize; ++y) {
      EXPECT_LT(mean_cover(y) - mean_cover(y + 8), 0.5) << "row " << y;
    }
    EXPECT_LT(mean_cover(kSize - 2), 0.1);
    for (int y = 0; y < kClosed; ++y) {
      for (int x = kSize * kCardStripCount / kTextureStripCount; x < kSize; ++x) {
        const std::uint8_t* texel = &picture[4 * static_cast<std::size_t>(y * kSize + x)];
        ASSERT_EQ(texel[3], 255) << x << ' ' << y;
        red += texel[0];
      }
    }
    // Below curls it lies in their shade: on white hair it looked like a bandage.
    if (curly) {
      EXPECT_LT(red / (kClosed * kSize / kTextureStripCount), 0.75 * 0.3 * 255);
    }
  }
}

TEST(HairPicture, IsClosedAtTheRootsAndOpenAtTheTips) {
  constexpr int kSize = 128;
  const ScreenColour brown(0.3, 0.22, 0.17);
  for (const bool curly : {false, true}) {
    const std::vector<std::uint8_t> picture = hair_picture(kSize, brown, curly);
    ASSERT_EQ(picture.size(), 4U * kSize * kSize);
    const auto mean = [&](int row, std::size_t channel, int end) {
      double sum = 0;
      for (int x = 0; x < end; ++x)
        sum += picture[4 * static_cast<std::size_t>(row * kSize + x) + channel];
      return sum / end / 255;
    };
    const int dense = kSize * kThinStrip / kTextureStripCount;
    EXPECT_GT(mean(kSize / 4, 3, dense), 0.7) << curly;
    EXPECT_LT(mean(0, 3, kSize), 0.5) << curly << ": roots, too, stand apart";
    EXPECT_LT(mean(kSize - 2, 3, kSize), 0.2) << curly;
    EXPECT_NEAR(mean(kSize / 2, 0, kSize), brown[0], 0.1);
    EXPECT_NEAR(mean(kSize / 2, 2, kSize), brown[2], 0.06);
  }
}

TEST(HairPicture, StaysAsOpaqueAtLowResolution) {
  // The fraction of the dense strips that is visible if opacity is rounded to 0 or 1.
  const auto visible = [](int size, int block) {
    const std::vector<std::uint8_t> picture = hair_picture(size, {0.3, 0.2, 0.1}, false);
    int opaque = 0, blocks = 0;
    for (int y = 0; y + block <= size; y += block) {
      for (int x = 0; x + block <= size * kThinStrip / kTextureStripCount; x += block, ++blocks) {
        int sum = 0;
        for (int i = 0; i < block * block; ++i) {
          const int texel = (y + i / block) * size + x + i % block;
          sum += picture[4 * static_cast<std::size_t>(texel) + 3];
        }
        opaque += sum > 127 * block * block ? 1 : 0;
      }
    }
    return static_cast<double>(opaque) / blocks;
  };
  for (const int block : {2, 4, 8})
    EXPECT_NEAR(visible(512, block), visible(512, 1), 0.06) << block;
}

TEST(HairColours, ANamedOneIsItsOwnNearest) {
  for (const HairColour& colour : hair_colours())
    EXPECT_EQ(nearest_hair_colour(colour.colour).name, colour.name);
  EXPECT_EQ(nearest_hair_colour({0.1, 0.1, 0.1}).name, "black");
}

}  // namespace
}  // namespace crowdface::synth
