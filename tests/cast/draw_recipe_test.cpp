// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/draw_recipe.h"

#include <cmath>
#include <functional>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/cast/ageing.h"
#include "crowdface/cast/face_ids.h"
#include "crowdface/core/require.h"
#include "crowdface/plane/layout.h"
#include "crowdface/smooth/level_size.h"

#include "cast/any_face.h"

namespace crowdface {
namespace {

using testing::draw_any_face;

constexpr std::uint64_t kMany = 4000;

CastingOptions example() {
  CastingOptions casting;
  casting.name = "mob";
  casting.count = kMany;
  casting.seed = 3;
  casting.anchors = circle_layout(5);
  casting.region_names = {"top", "low"};
  casting.sampling.targets = {{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}};
  casting.sampling.sources = {0, 1, 2, 3, 4};
  casting.sampling.regions.resize(2);
  casting.level_scale = {OperatorKind::kUmbrella, 1000, 2};
  return casting;
}

TEST(DrawRecipe, AGroupDrawsByItsOwnNumbers) {
  CastingOptions casting = example();
  Group group = {"elderly", {}, 0.5, casting.sampling};
  group.sampling.targets = {{1, 1}, {3, 1}};
  group.sampling.sources = {1, 3};
  for (RegionSampling& region : group.sampling.regions) region.extrapolation = {1.3, 1.3};
  casting.groups = {group};
  const FaceDistribution kind = distribution_of_group(casting, 0);
  for (std::uint64_t index = 1; index <= 50; ++index) {
    const FacePlan face = random_face(casting, index, 0, kind);
    EXPECT_EQ(face.group, "elderly");
    EXPECT_TRUE(face.recipe.target == 1 || face.recipe.target == 3);
    for (const RegionRecipe& region : face.recipe.regions) {
      EXPECT_EQ(region.extrapolation, 1.3);
      for (const SourceWeight& source : region.weights) {
        EXPECT_TRUE(source.head == 1 || source.head == 3);
      }
    }
    EXPECT_FALSE(random_face(casting, index, 0, distribution_of_group(casting)).group)
        << "of none: by the numbers of the crowd";
  }
}

TEST(Ageing, CanBeTakenBack) {
  CastingOptions casting = example();
  casting.sampling.heads_tagged_old = {1, 4};
  const FacePlan young = random_face(casting, 7, 0, distribution_of_group(casting));
  FacePlan face = young;
  apply_age(face, {0.4}, casting);
  undo_age(face, casting);
  EXPECT_FALSE(face.age);
  for (std::size_t k = 0; k < face.recipe.regions.size(); ++k) {
    const auto &back = face.recipe.regions[k].weights, &before = young.recipe.regions[k].weights;
    ASSERT_EQ(back.size(), before.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
      EXPECT_EQ(back[i].head, before[i].head);
      EXPECT_NEAR(back[i].weight, before[i].weight, 1e-9);
    }
  }
}

// The weights went to all old heads in equal parts: ten old people had the same wrinkles, and women
// those of men.
TEST(Ageing, DetailComesFromTheNearestOldHead) {
  CastingOptions casting = example();
  casting.sampling.heads_tagged_old = {1, 2, 3};  // 1 is nearest to 0 on the circle
  const auto aged = [&](Index source, double age) {
    FacePlan face = draw_any_face(casting, 7);
    for (RegionRecipe& region : face.recipe.regions) region.weights = {{source, 1}};
    apply_age(face, {age}, casting);
    return face.recipe.regions[0].weights;
  };
  EXPECT_EQ(aged(0, 0.25), (std::vector<SourceWeight>{{0, 0.75}, {1, 0.25}}));
  EXPECT_EQ(aged(4, 0.25), (std::vector<SourceWeight>{{3, 0.25}, {4, 0.75}}));
  EXPECT_EQ(aged(2, 0.25), (std::vector<SourceWeight>{{2, 1}})) << "is old";
  casting.tags = {{"female", "pale", "curly"},
                  {"male", "old", "pale", "curly"},
                  {"female", "old"},
                  {"female", "old", "pale"},
                  {"male"}};
  EXPECT_EQ(aged(0, 1), (std::vector<SourceWeight>{{3, 1}})) << "sex, then tags, then place";
  EXPECT_EQ(aged(4, 1), (std::vector<SourceWeight>{{1, 1}}));
}

TEST(Ageing, MeetsAnAgeInYears) {
  CastingOptions casting = example();
  casting.head_ages_years = {20, 60, 70, 80, 40};
  casting.sampling.heads_tagged_old = {1, 2, 3};
  casting.sampling.heads_tagged_young = {0};
  const auto years_of = [&](const std::vector<SourceWeight>& weights, double years) {
    FacePlan face = draw_any_face(casting, 7);
    for (RegionRecipe& region : face.recipe.regions) region.weights = weights;
    const Age age = {years, AgeUnit::kYears};
    apply_age(face, age, casting);
    double mean = 0;
    for (const SourceWeight& source : face.recipe.regions[0].weights) {
      mean += source.weight * casting.head_ages_years[static_cast<std::size_t>(source.head)];
    }
    return mean;
  };
  constexpr double kRounding = 0.01;  // the age from −1 to 1 is rounded to four decimals
  EXPECT_NEAR(years_of({{0, 1}}, 50), 50, kRounding);
  EXPECT_NEAR(years_of({{0, 0.5}, {4, 0.5}}, 35), 35, kRounding);
  EXPECT_NEAR(years_of({{0, 0.25}, {2, 0.75}}, 30), 30, kRounding) << "old faces become younger";
  EXPECT_NEAR(years_of({{0, 1}}, 75), 60, kRounding) << "head 1, the old head nearest to head 0";
  EXPECT_NEAR(years_of({{2, 1}}, 75), 70, kRounding) << "old heads keep their weight";
  casting.sampling.heads_tagged_old.clear();
  EXPECT_NEAR(years_of({{0, 1}}, 50), 20, kRounding) << "no old head";
  casting.head_ages_years.clear();
  EXPECT_THROW(years_of({{0, 1}}, 50), BrokenPrecondition);
}

// A group of people from 30 to 45 had faces with the skulls and grey hair of old heads.
TEST(Ageing, AnAgeInYearsChoosesTargetsOfThisAge) {
  CastingOptions casting = example();
  casting.sampling.heads_tagged_old = {3, 4};
  casting.sampling.heads_tagged_young = {0};
  const auto targets_at = [&](double years, std::vector<double> ages) {
    casting.head_ages_years = std::move(ages);
    casting.sampling.age = {{years, years}, AgeUnit::kYears};
    std::set<Index> targets;
    for (std::uint64_t i = 1; i <= 100; ++i)
      targets.insert(draw_any_face(casting, i).recipe.target);
    return targets;
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(targets_at(40, {20, 30, 40, 55, 70}), ElementsAre(1, 2, 3));
  EXPECT_THAT(targets_at(40, {30, 30, 40, 55, 50}), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(targets_at(70, {20, 30, 40, 55, 70}), ElementsAre(2, 3, 4)) << "at least three";
}

/// Three bands; the skin comes from two heads only and ages, the build does not.
CastingOptions banded_example() {
  CastingOptions casting = example();
  auto& bands = casting.sampling.bands;
  const auto from = [](double fraction) {
    return SmoothnessDistribution{SmoothnessDistribution::Unit::kFraction, {fraction, fraction}};
  };
  bands = {{"build", {}, {}, 0}, {"features", {}, {}, 0.5}, {"skin", {}, {{1, 4}}, 1}};
  for (BandSampling& band : bands) band.regions.resize(2);
  for (std::size_t k = 0; k < 2; ++k) {
    bands[1].regions[k].smoothness = from(0.1);
    bands[1].regions[k].extrapolation = {1.2, 1.2};
    bands[2].regions[k].smoothness = from(0.01);
  }
  return casting;
}

TEST(Bands, AreDrawnApartAndTheFirstAsWithoutOthers) {
  const CastingOptions casting = banded_example();
  std::set<double> places;
  for (std::uint64_t index = 1; index <= 50; ++index) {
    const FacePlan face = draw_any_face(casting, index);
    const FacePlan alone = draw_any_face(example(), index);
    for (std::size_t k = 0; k < 2; ++k) {
      const RegionRecipe& region = face.recipe.regions[k];
      EXPECT_EQ(region.position, alone.recipe.regions[k].position);
      EXPECT_EQ(region.weights, alone.recipe.regions[k].weights);
      EXPECT_EQ(region.iterations, alone.recipe.regions[k].iterations);
      ASSERT_EQ(region.finer_bands.size(), 2U);
      EXPECT_EQ(region.finer_bands[0].iterations, 100U);
      EXPECT_EQ(region.finer_bands[0].extrapolation, 1.2);
      EXPECT_EQ(region.finer_bands[1].iterations, 10U);
      for (std::size_t b = 0; b < 3; ++b) {
        const PlanePoint& at = *band_of(region, b).position;
        places.insert(at.x() + 10 * at.y());
      }
      for (const SourceWeight& source : region.finer_bands[1].weights) {
        EXPECT_TRUE(source.head == 1 || source.head == 4 || source.head == face.recipe.target);
      }
    }
  }
  EXPECT_EQ(places.size(), 300U) << "each has a place of its own";
}

TEST(Bands, ARegionsOwnValuesHoldForAllBands) {
  const CastingOptions casting = banded_example();
  ManualRecipe hand;
  hand.id = "mine";
  hand.target = 2;
  hand.regions.resize(2);
  hand.regions[0].weights = {{0, 1}, {3, 1}};
  hand.regions[0].extrapolation = Range{0.7, 0.7};
  hand.regions[0].bands.resize(3);
  hand.regions[0].bands[2].weights = {{1, 1}};
  const RegionRecipe region = completed_face_plan(casting, hand).recipe.regions[0];
  const std::vector<SourceWeight> halves = {{0, 0.5}, {3, 0.5}};
  EXPECT_EQ(region.weights, halves);
  EXPECT_EQ(region.finer_bands[0].weights, halves);
  EXPECT_EQ(region.finer_bands[1].weights, (std::vector<SourceWeight>{{1, 1}}));
  for (std::size_t b = 0; b < 3; ++b) EXPECT_EQ(band_of(region, b).extrapolation, 0.7);
}

TEST(Bands, BeginNoHigherThanTheBandBefore) {
  const CastingOptions casting = banded_example();
  ManualRecipe hand;
  hand.id = "mine";
  hand.regions.resize(2);
  hand.regions[0].smoothness =
      SmoothnessDistribution{SmoothnessDistribution::Unit::kFraction, {0.05, 0.05}};
  const RegionRecipe region = completed_face_plan(casting, hand).recipe.regions[0];
  EXPECT_EQ(region.iterations, 50U);
  EXPECT_EQ(region.finer_bands[0].iterations, 50U);
  EXPECT_EQ(region.finer_bands[1].iterations, 10U);
}

TEST(Bands, AgeActsOnThoseThatCarryIt) {
  CastingOptions casting = banded_example();
  casting.sampling.heads_tagged_old = {1};
  const FacePlan young = draw_any_face(casting, 7);
  FacePlan old = young;
  apply_age(old, {0.8}, casting);
  const auto share_of_old = [](const BandRecipe& band) {
    double share = 0;
    for (const SourceWeight& source : band.weights) share += source.head == 1 ? source.weight : 0;
    return share;
  };
  for (std::size_t k = 0; k < 2; ++k) {
    const RegionRecipe &before = young.recipe.regions[k], &after = old.recipe.regions[k];
    EXPECT_EQ(after.weights, before.weights);
    EXPECT_EQ(after.position, before.position);
    for (std::size_t b = 1; b < 3; ++b) {
      const double share = b == 1 ? 0.4 : 0.8;
      EXPECT_NEAR(share_of_old(band_of(after, b)),
                  share + (1 - share) * share_of_old(band_of(before, b)), 1e-12);
      EXPECT_FALSE(band_of(after, b).position);
    }
  }
  undo_age(old, casting);
  EXPECT_FALSE(old.age);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t b = 0; b < 3; ++b) {
      const BandRecipe &a = band_of(old.recipe.regions[k], b),
                       &c = band_of(young.recipe.regions[k], b);
      ASSERT_EQ(a.weights.size(), c.weights.size());
      for (std::size_t i = 0; i < a.weights.size(); ++i) {
        EXPECT_NEAR(a.weights[i].weight, c.weights[i].weight, 1e-9);
      }
    }
  }
}

/// Hand-written recipes, then the first draw of each face.
std::vector<FacePlan> draw_crowd(const CastingOptions& casting) {
  std::vector<FacePlan> crowd;
  for (const ManualRecipe& hand : casting.recipes)
    crowd.push_back(completed_face_plan(casting, hand));
  for (std::uint64_t i = 1; i <= casting.count; ++i) crowd.push_back(draw_any_face(casting, i));
  return crowd;
}

bool same(const FacePlan& a, const FacePlan& b) {
  if (a.id != b.id || a.index != b.index || a.recipe.target != b.recipe.target ||
      a.notes.attempt != b.notes.attempt) {
    return false;
  }
  for (std::size_t k = 0; k < a.recipe.regions.size(); ++k) {
    const RegionRecipe &x = a.recipe.regions[k], &y = b.recipe.regions[k];
    if (x.position != y.position || x.weights != y.weights || x.smoothness != y.smoothness ||
        x.iterations != y.iterations || x.extrapolation != y.extrapolation) {
      return false;
    }
  }
  return a.recipe.regions.size() == b.recipe.regions.size();
}

/// Smallest, mean and largest of one number of all faces.
struct Spread {
  double low = HUGE_VAL, mean = 0, high = -HUGE_VAL;
};
Spread spread(const std::vector<FacePlan>& crowd,
              const std::function<double(const FacePlan&)>& number) {
  Spread result;
  for (const FacePlan& face : crowd) {
    result.low = std::min(result.low, number(face));
    result.high = std::max(result.high, number(face));
    result.mean += number(face) / static_cast<double>(crowd.size());
  }
  return result;
}

TEST(DrawRecipe, FacesDoNotDependOnTheCount) {
  CastingOptions casting = example();
  const auto crowd = draw_crowd(casting);
  ASSERT_EQ(crowd.size(), kMany);
  casting.count = 10;
  const auto few = draw_crowd(casting);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_TRUE(same(few[i], crowd[i]));
  EXPECT_TRUE(same(draw_any_face(casting, 3777), crowd[3776])) << "also beyond the count";
}

TEST(DrawRecipe, SeedsAndIndicesGiveOtherFaces) {
  CastingOptions casting = example();
  const auto a = draw_crowd(casting);
  casting.seed = 4;
  const auto b = draw_crowd(casting);
  std::set<double> smoothness;
  for (std::size_t i = 0; i < kMany; ++i) {
    EXPECT_NE(a[i].recipe.regions[0].smoothness, b[i].recipe.regions[0].smoothness);
    for (const RegionRecipe& region : a[i].recipe.regions) smoothness.insert(region.smoothness);
  }
  EXPECT_EQ(smoothness.size(), 2 * kMany) << "regions are drawn apart";
}

TEST(DrawRecipe, IdsCountFromOne) {
  EXPECT_EQ(face_id("mob", 1), "mob_0001");
  EXPECT_EQ(face_id("mob", 9999), "mob_9999");
  EXPECT_EQ(face_id("mob", 123456), "mob_123456");
  const FacePlan face = draw_any_face(example(), 12);
  EXPECT_EQ(face.id, "mob_0012");
  EXPECT_EQ(face.index, 12U);
}

TEST(DrawRecipe, TargetsComeByWeight) {
  CastingOptions casting = example();
  casting.sampling.targets = {{1, 3}, {4, 1}};
  std::map<Index, double> share;
  for (const FacePlan& r : draw_crowd(casting)) share[r.recipe.target] += 1. / kMany;
  EXPECT_EQ(share.size(), 2U);
  EXPECT_NEAR(share[1], 0.75, 0.03);
}

TEST(DrawRecipe, UniformPositionsFillTheHullOfTheSources) {
  CastingOptions casting = example();
  casting.sampling.sources = {0, 1, 3};
  casting.sampling.regions[1].position.kind = PositionDistribution::Kind::kUniform;
  const std::vector<PlanePoint> corner = {casting.anchors[0], casting.anchors[1],
                                          casting.anchors[3]};
  const auto cross = [](const PlanePoint& a, const PlanePoint& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const double area = cross(corner[1] - corner[0], corner[2] - corner[0]);
  PlanePoint middle(0, 0);
  double near_first = 0;
  for (const FacePlan& r : draw_crowd(casting)) {
    const PlanePoint m = *r.recipe.regions[1].position;
    double parts[3];
    for (std::size_t c = 0; c < 3; ++c) {
      const PlanePoint &a = corner[(c + 1) % 3], &b = corner[(c + 2) % 3];
      parts[c] = cross(b - a, m - a) / area;  // barycentric
      EXPECT_GE(parts[c], -1e-12);
    }
    near_first += (parts[0] > 0.5 ? 1. : 0.) / kMany;
    middle += m / static_cast<double>(kMany);
  }
  EXPECT_LT((middle - (corner[0] + corner[1] + corner[2]) / 3).norm(), 0.03);
  EXPECT_NEAR(near_first, 0.25, 0.03) << "uniform by area";
}

TEST(DrawRecipe, AnchoredPositionsStayNearASource) {
  CastingOptions casting = example();
  casting.sampling.sources = {0, 1, 3};
  casting.sampling.regions[1].position.pull = 0.2;
  std::map<Index, double> share;
  for (const FacePlan& r : draw_crowd(casting)) {
    const PlanePoint m = *r.recipe.regions[1].position;
    Index nearest = 0;
    for (const Index head : casting.sampling.sources) {
      const auto at = [&](Index h) { return casting.anchors[static_cast<std::size_t>(h)]; };
      if ((m - at(head)).norm() < (m - at(nearest)).norm()) nearest = head;
    }
    EXPECT_LE((m - casting.anchors[static_cast<std::size_t>(nearest)]).norm(), 0.2 * 2);
    share[nearest] += 1. / kMany;
  }
  ASSERT_EQ(share.size(), 3U);
  for (const auto& [head, part] : share) EXPECT_NEAR(part, 1. / 3, 0.03) << head;

  casting.sampling.regions[1].position.pull = 0;
  casting.sampling.targets = {{2, 1}};
  const FacePlan on_anchor = draw_any_face(casting, 1);
  ASSERT_EQ(on_anchor.recipe.regions[1].weights.size(), 1U) << "all weight on one head";
}

TEST(DrawRecipe, AttemptsDrawAnew) {
  const CastingOptions casting = example();
  std::set<double> smoothness;
  for (std::uint32_t attempt = 0; attempt < 50; ++attempt) {
    const FacePlan face = draw_any_face(casting, 4, attempt);
    EXPECT_EQ(face.notes.attempt, attempt);
    EXPECT_EQ(face.id, "mob_0004");
    smoothness.insert(face.recipe.regions[0].smoothness);
  }
  EXPECT_EQ(smoothness.size(), 50U);
}

TEST(DrawRecipe, AroundStaysInTheDisc) {
  CastingOptions casting = example();
  casting.sampling.regions[0].position = {PositionDistribution::Kind::kAround, 2, 0.3};
  casting.sampling.regions[1].position = {PositionDistribution::Kind::kAround, std::nullopt, 0.5};
  double inner = 0;
  PlanePoint middle(0, 0);
  for (const FacePlan& r : draw_crowd(casting)) {
    const PlanePoint offset = *r.recipe.regions[0].position - casting.anchors[2];
    EXPECT_LE(offset.norm(), 0.3 * (1 + 1e-12));
    EXPECT_LE(
        (*r.recipe.regions[1].position - casting.anchors[static_cast<std::size_t>(r.recipe.target)])
            .norm(),
        0.5 * (1 + 1e-12));
    inner += (offset.norm() < 0.15 ? 1. : 0.) / kMany;
    middle += offset / static_cast<double>(kMany);
  }
  EXPECT_NEAR(inner, 0.25, 0.03) << "uniform by area";
  EXPECT_LT(middle.norm(), 0.01);
}

TEST(DrawRecipe, FixedStaysPut) {
  CastingOptions casting = example();
  casting.count = 20;
  casting.sampling.regions[0].position = {
      PositionDistribution::Kind::kFixed, {}, 0, PlanePoint(0.25, -0.75)};
  for (const FacePlan& r : draw_crowd(casting)) {
    EXPECT_EQ(*r.recipe.regions[0].position, PlanePoint(0.25, -0.75));
    EXPECT_NE(*r.recipe.regions[1].position, PlanePoint(0.25, -0.75));
  }
}

TEST(DrawRecipe, RangesAreFilledAndKept) {
  CastingOptions casting = example();
  casting.sampling.regions[0].smoothness.range = {0.25, 0.5};
  casting.sampling.regions[0].extrapolation = {-1, 2};
  casting.sampling.regions[1].extrapolation = {1.5, 1.5};
  const auto crowd = draw_crowd(casting);
  const Spread smoothness = spread(crowd, [](auto& r) { return r.recipe.regions[0].smoothness; });
  EXPECT_GE(smoothness.low, 0.25);
  EXPECT_LE(smoothness.high, 0.5);
  EXPECT_NEAR(smoothness.low, 0.25, 0.005);
  EXPECT_NEAR(smoothness.high, 0.5, 0.005);
  EXPECT_NEAR(smoothness.mean, 0.375, 0.01);
  const Spread e = spread(crowd, [](auto& r) { return r.recipe.regions[0].extrapolation; });
  EXPECT_GE(e.low, -1);
  EXPECT_LE(e.high, 2);
  EXPECT_NEAR(e.mean, 0.5, 0.06);
  const Spread fixed = spread(crowd, [](auto& r) { return r.recipe.regions[1].extrapolation; });
  EXPECT_EQ(fixed.low, 1.5);
  EXPECT_EQ(fixed.high, 1.5);
}

TEST(DrawRecipe, FractionsBecomeTheNearestIterations) {
  CastingOptions casting = example();
  casting.sampling.regions[0].smoothness.range = {0, 1};
  for (const FacePlan& r : draw_crowd(casting)) {
    const RegionRecipe& region = r.recipe.regions[0];
    EXPECT_EQ(static_cast<double>(region.iterations), std::round(region.smoothness * 1000));
  }
  EXPECT_EQ(iterations_of(0, casting.level_scale), 0U);
  EXPECT_EQ(iterations_of(1, casting.level_scale), 1000U);
}

TEST(DrawRecipe, IterationsStandAsDrawn) {
  CastingOptions casting = example();
  casting.sampling.regions[0].smoothness = {SmoothnessDistribution::Unit::kIterations, {3, 6}};
  std::map<std::uint64_t, double> share;
  for (const FacePlan& r : draw_crowd(casting)) {
    share[r.recipe.regions[0].iterations] += 1. / kMany;
    EXPECT_NEAR(r.recipe.regions[0].smoothness,
                static_cast<double>(r.recipe.regions[0].iterations) / 1000, 1e-12);
  }
  ASSERT_THAT(share, ::testing::SizeIs(4));
  EXPECT_EQ(share.begin()->first, 3U);
  for (const auto& [iterations, part] : share) EXPECT_NEAR(part, 0.25, 0.1) << iterations;
}

TEST(DrawRecipe, SizesBecomeTheirIterations) {
  for (const OperatorKind kind : {OperatorKind::kUmbrella, OperatorKind::kLazy}) {
    CastingOptions casting = example();
    casting.level_scale.operator_kind = kind;
    const double largest = wavelength_of_iterations(kind, casting.level_scale.max_level, 2);
    std::uint64_t before = 0;
    for (const double size : {0.0, 8.0, 20.0, 50.0, largest}) {
      casting.sampling.regions[0].smoothness = {SmoothnessDistribution::Unit::kSize, {size, size}};
      const RegionRecipe region = draw_any_face(casting, 1).recipe.regions[0];
      EXPECT_GE(region.iterations, before);
      before = region.iterations;
      // The nearest whole iterations: no neighbour's size is nearer.
      if (size > 0) {
        EXPECT_EQ(region.iterations, iterations_for_wavelength(kind, size, 2));
      }
      EXPECT_NEAR(region.smoothness, static_cast<double>(region.iterations) / 1000, 1e-3);
    }
    EXPECT_EQ(before, casting.level_scale.max_level);
  }
}

// An empty list of sources was read beyond its end.
TEST(DrawRecipe, NeedsTargetsAndSources) {
  CastingOptions casting = example();
  casting.sampling.sources.clear();
  EXPECT_THROW(draw_any_face(casting, 1), BrokenPrecondition);
  casting = example();
  casting.sampling.targets.clear();
  EXPECT_THROW(draw_any_face(casting, 1), BrokenPrecondition);
}

TEST(DrawRecipe, TheNumberOfSourcesHoldsForEachRegionAlone) {
  CastingOptions casting = example();
  casting.sampling.max_sources = 1;
  ASSERT_GT(casting.region_names.size(), 1U);
  bool others_elsewhere = false;
  for (const FacePlan& face : draw_crowd(casting)) {
    std::set<Index> heads;
    for (const RegionRecipe& region : face.recipe.regions) {
      EXPECT_LE(region.weights.size(), 2U) << "one source and the target";
      for (const SourceWeight& weight : region.weights) heads.insert(weight.head);
    }
    others_elsewhere = others_elsewhere || heads.size() > 2;
  }
  EXPECT_TRUE(others_elsewhere);
}

TEST(DrawRecipe, SourcesAndTheirNumberAreKept) {
  CastingOptions casting = example();
  casting.sampling.targets = {{2, 1}};
  casting.sampling.sources = {0, 1, 3, 4};
  casting.sampling.max_sources = 2;
  std::size_t faces = 0, with_target = 0;
  for (const FacePlan& r : draw_crowd(casting)) {
    const auto& weights = r.recipe.regions[0].weights;
    EXPECT_LE(weights.size(), 3U);  // two sources and the target
    double sum = 0;
    Index previous = -1;
    for (const SourceWeight& w : weights) {
      sum += w.weight;
      EXPECT_GT(w.head, previous);
      EXPECT_GT(w.weight, 0);
      previous = w.head;
      with_target += w.head == 2 ? 1U : 0U;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    ++faces;
  }
  EXPECT_EQ(with_target, faces) << "the target takes part as face 0";
}

TEST(DrawRecipe, PrintedWeightsLeaveTheTargetOut) {
  CastingOptions casting = example();
  casting.normalization = Normalization::kPrinted;
  for (const FacePlan& r : draw_crowd(casting)) {
    for (const RegionRecipe& region : r.recipe.regions) {
      double sum = 0;
      for (const SourceWeight& w : region.weights) {
        EXPECT_NE(w.head, r.recipe.target);
        sum += w.weight;
      }
      EXPECT_GT(sum, 0);
      EXPECT_LT(sum, 1);
    }
  }
}

TEST(DrawRecipe, AnotherRegionDisturbsNone) {
  const CastingOptions casting = example();
  CastingOptions more = casting;
  more.region_names = {"new", "top", "low"};
  more.sampling.regions.resize(3);
  const FacePlan a = draw_any_face(casting, 5), b = draw_any_face(more, 5);
  EXPECT_EQ(a.recipe.target, b.recipe.target);
  EXPECT_EQ(a.recipe.regions[0].position, b.recipe.regions[1].position);
  EXPECT_EQ(a.recipe.regions[1].smoothness, b.recipe.regions[2].smoothness);
}

TEST(DrawRecipe, HandRecipesComeFirstAndAreNormalised) {
  CastingOptions casting = example();
  casting.count = 1;
  ManualRecipe hand;
  hand.id = "mine";
  hand.target = 3;
  hand.regions.resize(2);
  hand.regions[0].weights = {{4, 3}, {0, 1}};
  hand.regions[1].position = PlanePoint(0.5, 0.5);
  casting.recipes = {hand};
  const auto crowd = draw_crowd(casting);
  ASSERT_EQ(crowd.size(), 2U);
  EXPECT_EQ(crowd[0].id, "mine");
  EXPECT_FALSE(crowd[0].index);
  EXPECT_EQ(crowd[0].recipe.target, 3);
  EXPECT_THAT(crowd[0].recipe.regions[0].weights,
              ::testing::ElementsAre(SourceWeight{0, 0.25}, SourceWeight{4, 0.75}));
  EXPECT_FALSE(crowd[0].recipe.regions[0].position);
  EXPECT_EQ(crowd[0].recipe.regions[1].weights,
            weights_at_position(casting.anchors, 3, casting.sampling.sources, PlanePoint(0.5, 0.5),
                                Normalization::kPartition, std::nullopt));
  EXPECT_TRUE(same(crowd[1], draw_any_face(casting, 1)));

  casting.recipes[0].regions[0].weights = {{4, 0}};
  EXPECT_THROW(draw_crowd(casting), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
