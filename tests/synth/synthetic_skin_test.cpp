// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/synthetic_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include "crowdface/core/hash.h"
#include "crowdface/core/require.h"
#include "head_models/synth/complexion.h"
#include "head_models/synth/skin_atlas.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {
namespace {

constexpr int kSkinSize = 256;
using Colour = Eigen::Array3d;

const SyntheticSkins& skins() {
  static const SyntheticSkins only(kSkinSize);
  return only;
}

/// The mean colour of the texels that show the average head within `radius` cm of a place.
Colour colour_near(const std::vector<std::uint8_t>& albedo, const Eigen::Vector3d& place,
                   double radius) {
  static const synth::SkinAtlas atlas(kSkinSize);
  Colour sum = Colour::Zero();
  double count = 0;
  for (std::size_t i = 0; i < atlas.size(); ++i) {
    if (!atlas.is_covered(i) || (atlas[i].skin.position - place).norm() > radius) continue;
    sum += Colour(albedo[3 * i], albedo[3 * i + 1], albedo[3 * i + 2]);
    count += 1;
  }
  EXPECT_GT(count, 3);
  return sum / count;
}

const Eigen::Vector3d kForehead(0, 5, 9), kCheek(4.6, -3, 8), kLowerLip(0, -7.45, 10.2),
    kChin(0, -10, 9.5), kCrown(0, 13, -1);

TEST(SyntheticSkins, SameSeedSameBytesOnEveryMachine) {
  const SyntheticSkins small(64);
  const std::vector<std::uint8_t> albedo = small.albedo(3, 2);
  EXPECT_EQ(albedo.size(), 64U * 64U * 3U);
  EXPECT_EQ(albedo, small.albedo(3, 2));
  EXPECT_NE(albedo, small.albedo(3, 3));
  EXPECT_NE(albedo, small.albedo(4, 2));
  EXPECT_EQ(Hasher().add_array(std::span(albedo)).digest().hex(),
            "e2ddcfe0cae377655911f871812c851a");
}

// The pupil used to be five texels wide and three high.
TEST(SyntheticSkins, PupilsAreRound) {
  constexpr int kSize = 1024;
  const std::vector<std::uint8_t> albedo = SyntheticSkins(kSize).albedo(1, 1);
  const synth::SkinAtlas atlas(kSize);
  for (const double side : {1.0, -1.0}) {
    int left = kSize, right = 0, top = kSize, bottom = 0, count = 0;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const auto i = static_cast<std::size_t>(y * kSize + x);
        const bool dark = std::max({albedo[3 * i], albedo[3 * i + 1], albedo[3 * i + 2]}) < 16;
        // A dark iris below the lid's shadow is as dark, but farther out.
        const bool inner = atlas[i].point_on_ball.head<2>().norm() < 0.17;
        if (!dark || !inner || atlas[i].on_eyeball < 0.5 || (x > kSize / 2) != (side > 0)) continue;
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
        ++count;
      }
    }
    const double width = right - left + 1, height = bottom - top + 1;
    EXPECT_GT(width, 20);
    EXPECT_NEAR(height / width, 1.18, 0.08) << "texels are wider than high";
    EXPECT_NEAR(count / (width * height), std::numbers::pi / 4, 0.05) << "a disc, not a square";
  }
}

TEST(SyntheticSkins, EveryToneOccursAndShows) {
  std::array<bool, 5> seen{};
  double lightest = 0, darkest = 255;
  for (std::uint64_t i = 0; i < 10; ++i) {
    const double tone = synth::random_complexion(1, i).skin_tone;
    seen[static_cast<std::size_t>(5 * tone)] = true;
    const double light = colour_near(skins().albedo(1, i), kForehead, 1.5).mean();
    lightest = std::max(lightest, light);
    darkest = std::min(darkest, light);
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 5);
  EXPECT_GT(lightest, 2 * darkest);
}

// A face that is mixed of haired heads may be bald.
TEST(SyntheticSkins, UnderHairInCardsTheCrownIsSkinWithRoots) {
  const SyntheticSkins under_hair(kSkinSize, SyntheticHeads::Scalp::kShorn);
  for (std::uint64_t i = 0; i < 6; ++i) {
    const std::vector<std::uint8_t> rooted = under_hair.albedo(1, i), haired = skins().albedo(1, i);
    const Colour skin = colour_near(haired, kForehead, 1);
    EXPECT_EQ(colour_near(rooted, kCheek, 1).matrix(), colour_near(haired, kCheek, 1).matrix());
    // The roots have no hair colour: the hair above may have any.
    EXPECT_LT((colour_near(rooted, kCrown, 3) - skin).matrix().norm(), 0.25 * skin.matrix().norm())
        << i;
  }
}

TEST(SyntheticSkins, LipsAreRedderThanTheForeheadAndCheeksAreNotGrey) {
  for (std::uint64_t i = 0; i < 6; ++i) {
    const std::vector<std::uint8_t> albedo = skins().albedo(1, i);
    const auto redness = [&](const Eigen::Vector3d& place) {
      const Colour colour = colour_near(albedo, place, 0.4);
      return colour[0] / colour[1];
    };
    EXPECT_GT(redness(kLowerLip), redness(kForehead) + 0.05) << i;
    EXPECT_GT(redness(kCheek), 1.1) << i;
  }
}

/// The first head of seed 1 of this sex within these ages.
std::uint64_t head_of(bool male, double from, double to) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    const synth::Person person = synth::random_person(1, i);
    if ((person.maleness > 0) == male && person.age_years >= from && person.age_years < to)
      return i;
  }
  ADD_FAILURE() << "no such head";
  return 0;
}

TEST(SyntheticSkins, MenHaveBeardsAndWomenHaveNone) {
  const auto chin_against_forehead = [](std::uint64_t index) {
    const std::vector<std::uint8_t> albedo = skins().albedo(1, index);
    return colour_near(albedo, kChin, 0.8).mean() / colour_near(albedo, kForehead, 1.5).mean();
  };
  std::optional<std::uint64_t> bearded;
  for (std::uint64_t i = 0; i < 100 && !bearded; ++i) {
    if (synth::random_complexion(1, i).beard == 1 && synth::random_complexion(1, i).skin_tone < 0.5)
      bearded = i;
  }
  ASSERT_TRUE(bearded);
  EXPECT_LT(chin_against_forehead(*bearded), 0.8);
  for (std::uint64_t i = 0; i < 40; ++i) {
    if (synth::random_person(1, i).maleness > 0) continue;
    EXPECT_EQ(synth::random_complexion(1, i).beard, 0) << i;
  }
  EXPECT_GT(chin_against_forehead(head_of(false, 18, 40)), 0.85);
}

TEST(SyntheticSkins, HairGoesGreyAndRecedesWithTheYears) {
  double young = 0, old = 0, receding_young = 0, receding_old = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const synth::Person person = synth::random_person(1, i);
    const synth::Complexion look = synth::random_complexion(1, i);
    if (person.age_years < 35) young = std::max(young, look.hair.minCoeff());
    if (person.age_years > 72) old = std::max(old, look.hair.minCoeff());
    if (person.maleness > 0 && person.age_years < 30)
      receding_young = std::max(receding_young, look.recession);
    if (person.maleness > 0 && person.age_years > 70)
      receding_old = std::max(receding_old, look.recession);
  }
  EXPECT_GT(old, young + 0.1) << "blue of the hair";
  EXPECT_GT(receding_old, receding_young + 0.3);
}

// Five of six old men of one crowd were bald.
TEST(SyntheticSkins, HairlinesOfSuccessiveMenDiffer) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    int men = 0, with_hair = 0, receding = 0;
    for (std::uint64_t i = 0; i < 24; ++i) {
      if (synth::random_person(seed, i).maleness <= 0) continue;
      const double bare = synth::random_complexion(seed, i).recession;
      ++men;
      if (bare < 0.2) ++with_hair;
      if (bare > 0.8) ++receding;
    }
    EXPECT_GE(4 * with_hair, men) << seed;
    EXPECT_LE(2 * receding, men) << seed;
  }
}

TEST(SyntheticSkins, ScalpHasHairInItsColour) {
  const std::uint64_t woman = head_of(false, 18, 35);
  const Colour hair = 255 * synth::random_complexion(1, woman).hair;
  const Colour crown = colour_near(skins().albedo(1, woman), kCrown, 2.5);
  EXPECT_LT((crown - hair).abs().maxCoeff(), 25);
}

TEST(SyntheticSkins, EyesHaveAnIrisInItsColourAndAreWhiteAround) {
  constexpr int kLarge = 512;
  static const SyntheticSkins large(kLarge);
  const synth::SkinAtlas atlas(kLarge);
  for (std::uint64_t i = 0; i < 4; ++i) {
    const std::vector<std::uint8_t> albedo = large.albedo(1, i);
    const Colour iris = 255 * synth::random_complexion(1, i).iris;
    Colour in_iris = Colour::Zero(), white = Colour::Zero();
    double irises = 0, whites = 0;
    for (std::size_t t = 0; t < atlas.size(); ++t) {
      if (atlas[t].on_eyeball < 0.5 || !atlas.is_covered(t) || atlas[t].point_on_ball.z() < 0)
        continue;
      const double flat = atlas[t].point_on_ball.head<2>().norm();
      const Colour colour(albedo[3 * t], albedo[3 * t + 1], albedo[3 * t + 2]);
      if (flat > 0.2 && flat < 0.31) in_iris += colour, ++irises;
      const double height = atlas[t].point_on_ball.y();
      const bool shaded = height > -0.05 || height < -0.25;  // by the lids
      if (flat > 0.5 && flat < 0.7 && !shaded) white += colour, ++whites;
      if (flat < 0.1) {
        EXPECT_LT(colour.maxCoeff(), 30) << "the pupil";
      }
    }
    ASSERT_GT(irises, 10);
    EXPECT_LT((in_iris / irises - iris).abs().maxCoeff(), 25) << i;
    EXPECT_GT((white / whites).minCoeff(), 105) << i;
  }
}

TEST(SyntheticSkins, MenAreShavenStubblyOrBearded) {
  double men = 0, shaven = 0, stubbly = 0, moustaches = 0, bearded = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    if (synth::random_person(1, i).maleness < 0) continue;
    const synth::Complexion look = synth::random_complexion(1, i);
    ++men;
    shaven += look.moustache < 0.2 ? 1 : 0;
    stubbly += look.moustache > 0.3 && look.moustache < 0.9 ? 1 : 0;
    moustaches += look.moustache == 1 && look.beard < 1 ? 1 : 0;
    bearded += look.beard == 1 ? 1 : 0;
  }
  EXPECT_NEAR(shaven / men, 0.42, 0.06);
  EXPECT_NEAR(stubbly / men, 0.25, 0.06);
  EXPECT_NEAR(moustaches / men, 0.18, 0.06);
  EXPECT_NEAR(bearded / men, 0.15, 0.06);
}

TEST(SyntheticSkins, EachSexHasEveryTone) {
  for (const bool male : {false, true}) {
    std::array<int, 5> seen{};
    for (std::uint64_t i = 10; i < 20; ++i) {
      if ((synth::random_person(4, i).maleness > 0) != male) continue;
      ++seen[static_cast<std::size_t>(5 * synth::random_complexion(4, i).skin_tone)];
    }
    EXPECT_EQ(seen, (std::array<int, 5>{1, 1, 1, 1, 1})) << male;
  }
}

TEST(SkinAtlas, HoldsTheAverageHeadWhereItsVerticesLie) {
  const SyntheticHeads heads(20'000);
  const synth::SkinAtlas atlas(kSkinSize);
  std::size_t covered = 0;
  for (std::size_t i = 0; i < atlas.size(); ++i) {
    const synth::AtlasTexel place = atlas[i];
    covered += atlas.is_covered(i) ? 1 : 0;
    EXPECT_LT(place.skin.position.norm(), 30);
    EXPECT_NEAR(place.skin.normal.norm(), 1, 1e-6);
  }
  EXPECT_GT(covered, atlas.size() / 2);
  // Any head of any seed lies near the average one: compare through the texture coordinates.
  const Positions head = heads.positions(1, 1);
  const Topology& topology = heads.topology();
  double sum = 0;
  for (Index c = 0; c < topology.corner_count(); ++c) {
    const auto k = static_cast<std::size_t>(c);
    const auto uv = heads.uvs().row(topology.corner_uvs[k]);
    const auto x = static_cast<std::size_t>(std::min(uv.x() * kSkinSize, kSkinSize - 1.0));
    const auto y = static_cast<std::size_t>(std::min((1 - uv.y()) * kSkinSize, kSkinSize - 1.0));
    sum +=
        (atlas[y * kSkinSize + x].skin.position.transpose() - head.row(topology.corner_vertices[k]))
            .norm();
  }
  EXPECT_LT(sum / static_cast<double>(topology.corner_count()), 1.2) << "centimetres";
}

TEST(SyntheticSkins, RefusesSizesOutOfRange) {
  EXPECT_THROW(SyntheticSkins(63), BrokenPrecondition);
  EXPECT_THROW(SyntheticSkins(8193), BrokenPrecondition);
}

/// The mean of a channel near a place of the average head.
double mean_near(const std::vector<std::uint8_t>& bytes, const Eigen::Vector3d& place) {
  std::vector<std::uint8_t> colours;
  for (const std::uint8_t value : bytes) colours.insert(colours.end(), 3, value);
  return colour_near(colours, place, 0.8).mean();
}

TEST(SyntheticSkins, NormalsHoldWhatTheMeshIsTooCoarseFor) {
  const SyntheticSkins fine(512);
  const synth::SkinAtlas atlas(512);
  // Root mean square of how far normals lean.
  const auto lean = [&](double edge_cm) {
    const std::vector<std::uint8_t> normals = fine.normals(3, 2, edge_cm);
    double squares = 0, count = 0;
    for (std::size_t i = 0; i < atlas.size(); ++i) {
      EXPECT_GE(normals[3 * i + 2], 128) << "outward";
      if (!atlas.is_covered(i)) continue;
      if (atlas[i].on_eyeball > 0.5) {
        EXPECT_EQ(normals[3 * i], 128) << "eyes are smooth";
        continue;
      }
      const double x = normals[3 * i] / 127.5 - 1, y = normals[3 * i + 1] / 127.5 - 1;
      squares += x * x + y * y;
      count += 1;
    }
    return std::sqrt(squares / count);
  };
  EXPECT_GT(lean(0.5), 0.012);
  EXPECT_LT(lean(0.02), 0.7 * lean(0.5)) << "a fine mesh has most of it itself";
  EXPECT_EQ(fine.normals(3, 2, 0.5), fine.normals(3, 2, 0.5));
  EXPECT_NE(fine.normals(3, 2, 0.5), fine.normals(3, 3, 0.5));
}

TEST(SyntheticSkins, LipsGleamMoreThanCheeks) {
  const std::vector<std::uint8_t> roughness = skins().roughness(1, 11);
  EXPECT_EQ(roughness.size(), static_cast<std::size_t>(kSkinSize) * kSkinSize);
  EXPECT_LT(mean_near(roughness, kLowerLip) + 15, mean_near(roughness, kCheek));
  EXPECT_LT(mean_near(roughness, kForehead), mean_near(roughness, kCheek));
}

}  // namespace
}  // namespace crowdface
