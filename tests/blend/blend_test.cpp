// SPDX-License-Identifier: Apache-2.0
#include "crowdface/blend/blend.h"

#include <algorithm>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include "crowdface/blend/crowd_blender.h"
#include "crowdface/core/instruction_set.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/smooth/cubic_fit.h"
#include "crowdface/smooth/iterate.h"
#include "crowdface/smooth/tiles.h"

#include "support/levels.h"
#include "support/meshes.h"
#include "support/smooth_fields.h"

namespace crowdface {
namespace {

/// Three random heads on an open sheet, and two regions with random masks.
class Blend : public ::testing::Test {
 protected:
  Blend() {
    faces_.topology = testing::grid_topology(9, 8);
    for (std::uint64_t h = 0; h < 3; ++h) {
      faces_.heads.push_back({std::string(1, static_cast<char>('a' + h)),
                              10 * testing::random_positions(faces_.topology.vertex_count, h + 1)});
    }
    const Positions noise = testing::random_positions(faces_.topology.vertex_count, 9);
    two_.alpha.resize(noise.rows(), 2);
    two_.alpha.col(0) = (noise.col(0).array() + 1) / 2;
    two_.alpha.col(1) = 1 - two_.alpha.col(0).array();
  }

  SmoothingOperator smoothing(Boundary boundary = Boundary::kFixed,
                              OperatorKind kind = OperatorKind::kUmbrella) const {
    return {build_adjacency(faces_.topology), boundary, kind};
  }
  ChebyshevFilter filter(Boundary boundary = Boundary::kFixed,
                         OperatorKind kind = OperatorKind::kUmbrella) const {
    return {smoothing(boundary, kind), head(0)};
  }
  std::vector<CubicFit> cubic_fits(std::uint64_t max_level) const {
    std::vector<CubicFit> fits;
    for (const Head& h : faces_.heads) fits.push_back(fit_cubic(filter(), h.positions, max_level));
    return fits;
  }
  CrowdBlender blender(const std::vector<CubicFit>& fits, const RegionWeights& regions) const {
    return {faces_, levels_of(fits), patches_of(levels_of(fits)), regions};
  }
  static std::vector<HeadSmoothing> levels_of(const std::vector<CubicFit>& fits) {
    std::vector<HeadSmoothing> levels;
    for (const CubicFit& fit : fits) {
      levels.push_back({fit.fields, [&fit](std::uint64_t level) {
                          const auto basis = cubic_basis(level, fit.max_level);
                          return std::vector<double>(basis.begin(), basis.end());
                        }});
    }
    return levels;
  }
  /// Each patch by all of its vertices, as fields are noise; the skeletons of faces that are alike
  /// have tests of their own.
  FieldPatches patches_of(const std::vector<HeadSmoothing>& levels) const {
    const std::vector<std::uint64_t> tested = {1, 3, 10, 30, 60};
    return interpolate_fields(levels, tested, hilbert_order(head(0)), 1e-4);
  }
  const Positions& head(std::size_t h) const { return faces_.heads[h].positions; }
  static Positions level(const SmoothingOperator& smoothing, const Positions& x, std::uint64_t l) {
    return iterate(smoothing, x, l);
  }

  static Recipe recipe(Index target, std::vector<RegionRecipe> regions) {
    Recipe result;
    result.target = target;
    result.regions = std::move(regions);
    return result;
  }
  static RegionRecipe region(std::vector<SourceWeight> weights, std::uint64_t iterations,
                             double extrapolation = 1) {
    return {{std::nullopt, std::move(weights), 0, iterations, extrapolation}, {}};
  }

  /// Bands from coarse to fine, each with whom, where it begins, and how strong.
  static RegionRecipe bands(const std::vector<RegionRecipe>& each) {
    RegionRecipe result = each.front();
    for (std::size_t b = 1; b < each.size(); ++b) result.finer_bands.push_back(each[b]);
    return result;
  }
  /// Σ_k α_k [ S_{L_k1} B + Σ_b e_kb Σ_i ω̂_kbi (S_{L_k,b+1} C_i − S_{L_kb} C_i) ], term by term.
  template <class Level>
  Positions term_by_term(const Recipe& recipe, const RegionWeights& regions,
                         const Level& level_of) const {
    Positions sum = Positions::Zero(head(0).rows(), 3);
    for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
      const RegionRecipe& r = recipe.regions[k];
      Positions face = Positions::Zero(head(0).rows(), 3);
      for (const SourceWeight& part : target_head_weights(recipe)) {
        face += part.weight * level_of(static_cast<std::size_t>(part.head), r.iterations);
      }
      for (std::size_t b = 0; b <= r.finer_bands.size(); ++b) {
        const BandRecipe& band = b == 0 ? r : r.finer_bands[b - 1];
        for (const SourceWeight& source : band.weights) {
          const auto h = static_cast<std::size_t>(source.head);
          const Positions end =
              b < r.finer_bands.size() ? level_of(h, r.finer_bands[b].iterations) : head(h);
          face += band.extrapolation * source.weight * (end - level_of(h, band.iterations));
        }
      }
      for (Index v = 0; v < sum.rows(); ++v) {
        sum.row(v) += regions.alpha(v, static_cast<Index>(k)) * face.row(v);
      }
    }
    return sum;
  }
  /// Three bands in one region, two in the other.
  Recipe banded() const {
    return recipe(0, {bands({region({{0, 0.3}, {1, 0.7}}, 40, 0.9), region({{2, 1}}, 9, 1.3),
                             region({{1, 0.5}, {2, 0.5}}, 2, -0.5)}),
                      bands({region({{1, 1}}, 25, 1.2), region({{0, 0.6}, {2, 0.4}}, 4)})});
  }

  HeadSet faces_;
  RegionWeights one_ = whole_head_weights(testing::grid_topology(9, 8));
  RegionWeights two_;
};

double difference(const Positions& a, const Positions& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

TEST_F(Blend, TargetAloneGivesTheTargetToTheBit) {
  for (const Boundary boundary : {Boundary::kFixed, Boundary::kFree}) {
    for (const std::uint64_t l : {0U, 1U, 7U, 300U}) {
      const Recipe alone = recipe(1, {region({{1, 1}}, l), region({{1, 1}}, 2 * l + 3)});
      EXPECT_EQ(blend_exact(faces_, filter(boundary), two_, alone), head(1)) << l;
    }
  }
}

TEST_F(Blend, BandsAreTheSumOfTheirDifferences) {
  for (const OperatorKind kind : {OperatorKind::kUmbrella, OperatorKind::kLazy}) {
    for (const Boundary boundary : {Boundary::kFixed, Boundary::kFree}) {
      const SmoothingOperator w = smoothing(boundary, kind);
      const auto exact = [&](std::size_t h, std::uint64_t l) { return level(w, head(h), l); };
      EXPECT_LT(difference(blend_exact(faces_, filter(boundary, kind), two_, banded()),
                           term_by_term(banded(), two_, exact)),
                1e-7);
      Recipe mixture = banded();
      set_target_heads(mixture, {{0, 0.25}, {2, 0.75}});
      EXPECT_LT(difference(blend_exact(faces_, filter(boundary, kind), two_, mixture),
                           term_by_term(mixture, two_, exact)),
                1e-7);
    }
  }
}

TEST_F(Blend, BandsOfFittedLevelsAreTheSumOfTheirDifferences) {
  const auto fits = cubic_fits(60);
  const auto fitted = [&](std::size_t h, std::uint64_t l) -> Positions {
    return testing::evaluate(fits[h], head(h), l);
  };
  EXPECT_LT(difference(blender(fits, two_).blend(banded()), term_by_term(banded(), two_, fitted)),
            1e-3)
      << "patches round to steps of their own";
}

TEST_F(Blend, BandsThatAreAlikeAreOneBand) {
  const auto like = [&](std::uint64_t l) { return region({{0, 0.5}, {2, 0.5}}, l, 1.2); };
  const Recipe one = recipe(1, {like(40)});
  const Recipe three = recipe(1, {bands({like(40), like(9), like(2)})});
  const auto fits = cubic_fits(60);
  EXPECT_EQ(blender(fits, one_).blend(three), blender(fits, one_).blend(one));
  EXPECT_LT(difference(blend_exact(faces_, filter(), one_, three),
                       blend_exact(faces_, filter(), one_, one)),
            1e-12);
}

TEST_F(Blend, ABandWithoutWidthAddsNothing) {
  const Recipe two = recipe(1, {bands({region({{0, 1}}, 20, 1.1), region({{2, 1}}, 6)})});
  Recipe more = two;
  more.regions[0].finer_bands.insert(more.regions[0].finer_bands.begin(), region({{1, 1}}, 6, 2));
  const auto fits = cubic_fits(60);
  EXPECT_LT(difference(blender(fits, one_).blend(more), blender(fits, one_).blend(two)), 1e-5);
  more.regions[0].finer_bands.push_back(region({{1, 1}}, 0, 3));  // a cubic is not exact at level 0
  EXPECT_LT(difference(blend_exact(faces_, filter(), one_, more),
                       blend_exact(faces_, filter(), one_, two)),
            1e-12);
}

TEST_F(Blend, ABandBeginsNoHigherThanTheCoarserOne) {
  const Recipe wrong = recipe(0, {bands({region({{1, 1}}, 5), region({{2, 1}}, 6)})});
  EXPECT_THROW(blend_exact(faces_, filter(), one_, wrong), BrokenPrecondition);
}

TEST_F(Blend, ChangingOneBandGivesTheBitsOfBlending) {
  const auto fits = cubic_fits(60);
  const CrowdBlender all = blender(fits, two_);
  Recipe after = banded();
  after.regions[1].finer_bands[0].weights = {{1, 1}};
  Positions face = all.blend(banded());
  all.update(banded(), after, face);
  EXPECT_EQ(face, all.blend(after));
}

TEST_F(Blend, LevelZeroGivesTheTargetToTheBit) {
  const Recipe unsmoothed = recipe(0, {region({{1, 0.25}, {2, 0.75}}, 0)});
  EXPECT_EQ(blend_exact(faces_, filter(), one_, unsmoothed), head(0));
}

TEST_F(Blend, TwoFacesFollowEquation2) {
  for (const OperatorKind kind : {OperatorKind::kUmbrella, OperatorKind::kLazy}) {
    for (const Boundary boundary : {Boundary::kFixed, Boundary::kFree}) {
      const SmoothingOperator w = smoothing(boundary, kind);
      const Positions expected = level(w, head(0), 13) + head(2) - level(w, head(2), 13);
      const Recipe transfer = recipe(0, {region({{2, 1}}, 13)});
      EXPECT_LT(difference(blend_exact(faces_, filter(boundary, kind), one_, transfer), expected),
                1e-7);
    }
  }
}

TEST_F(Blend, RegionsFollowEquation7) {
  const SmoothingOperator w = smoothing();
  const std::vector<RegionRecipe> regions = {region({{0, 0.5}, {1, 0.2}, {2, 0.3}}, 5, 0.9),
                                             region({{1, 1}}, 40, 1.3)};
  Positions expected = Positions::Zero(head(0).rows(), 3);
  for (Index k = 0; k < 2; ++k) {
    const RegionRecipe& r = regions[static_cast<std::size_t>(k)];
    Positions face = level(w, head(0), r.iterations);
    for (const SourceWeight& source : r.weights) {
      const Positions& c = head(static_cast<std::size_t>(source.head));
      face += r.extrapolation * source.weight * (c - level(w, c, r.iterations));
    }
    expected += two_.alpha.col(k).asDiagonal() * face;
  }
  EXPECT_LT(difference(blend_exact(faces_, filter(), two_, recipe(0, regions)), expected), 1e-7);
}

TEST_F(Blend, OrderOfSourcesChangesNothing) {
  const Recipe a = recipe(1, {region({{0, 0.5}, {1, 0.2}, {2, 0.3}}, 20, 1.1)});
  const Recipe b = recipe(1, {region({{2, 0.3}, {0, 0.5}, {1, 0.2}}, 20, 1.1)});
  EXPECT_LT(
      difference(blend_exact(faces_, filter(), one_, a), blend_exact(faces_, filter(), one_, b)),
      1e-12);
}

TEST_F(Blend, RegionsOfEqualParametersAreOneRegion) {
  const RegionRecipe same = region({{0, 0.4}, {2, 0.6}}, 30, 1.2);
  EXPECT_LT(difference(blend_exact(faces_, filter(), two_, recipe(0, {same, same})),
                       blend_exact(faces_, filter(), one_, recipe(0, {same}))),
            1e-12);
}

TEST_F(Blend, ExtrapolationIsLinear) {
  const auto face = [&](double e) {
    return blend_exact(faces_, filter(), one_, recipe(0, {region({{0, 0.4}, {2, 0.6}}, 30, e)}));
  };
  EXPECT_LT(difference(face(1.5), face(0) + 1.5 * (face(1) - face(0))), 1e-10);
  EXPECT_LT(difference(face(-2), face(0) - 2 * (face(1) - face(0))), 1e-10);
  EXPECT_LT(difference(face(0), level(smoothing(), head(0), 30)), 1e-7) << "no detail: B^L";
}

TEST_F(Blend, NoWeightsLeaveTheSmoothedTarget) {
  // The printed formula with m on the target.
  EXPECT_LT(difference(blend_exact(faces_, filter(), one_, recipe(0, {region({}, 25)})),
                       level(smoothing(), head(0), 25)),
            1e-7);
}

TEST_F(Blend, FixedRimKeepsTheTargetsBits) {
  const Adjacency adjacency = build_adjacency(faces_.topology);
  const Recipe any = recipe(2, {region({{0, 0.3}, {1, 0.7}}, 17, 1.4), region({{1, 1}}, 300, 0.2)});
  const Positions face = blend_exact(faces_, filter(), two_, any);
  Index rim = 0;
  for (Index i = 0; i < face.rows(); ++i) {
    if (!adjacency.boundary[static_cast<std::size_t>(i)]) continue;
    ++rim;
    EXPECT_EQ(face.row(i), head(2).row(i));
  }
  EXPECT_EQ(rim, 2 * (9 + 8));
}

TEST_F(Blend, ATargetThatIsAMixtureIsTheMixtureOfTheFaces) {
  const std::vector<SourceWeight> shares = {{0, 0.5}, {1, 0.2}, {2, 0.3}};
  const std::vector<RegionRecipe> regions = {region({{0, 0.25}, {2, 0.75}}, 7, 1.2),
                                             region({{1, 1}}, 30, 0.9)};
  Recipe mixed = recipe(0, regions);
  set_target_heads(mixed, shares);
  EXPECT_EQ(mixed.target, 0);
  const auto fits = cubic_fits(60);
  const CrowdBlender fitted = blender(fits, two_);
  Positions exact = Positions::Zero(head(0).rows(), 3), cubic = exact, target = exact;
  for (const SourceWeight& part : shares) {
    const Recipe one = recipe(part.head, regions);
    exact += part.weight * blend_exact(faces_, filter(), two_, one);
    cubic += part.weight * fitted.blend(one);
    target += part.weight * head(static_cast<std::size_t>(part.head));
  }
  const Positions face = blend_exact(faces_, filter(), two_, mixed);
  EXPECT_LT((face - exact).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((fitted.blend(mixed) - cubic).cwiseAbs().maxCoeff(), 1e-5) << "single precision";
  EXPECT_EQ(face.row(0), target_positions(faces_, mixed).row(0)) << "a fixed rim stays";
  EXPECT_LT((target_positions(faces_, mixed) - target).cwiseAbs().maxCoeff(), 1e-12);

  set_target_heads(mixed, {{1, 1}});
  EXPECT_TRUE(mixed.mixture.empty());
  EXPECT_EQ(mixed.target, 1);
}

TEST_F(Blend, CubicFollowsItsFormula) {
  const std::vector<CubicFit> fits = cubic_fits(50);
  const std::vector<RegionRecipe> regions = {region({{0, 0.5}, {1, 0.2}, {2, 0.3}}, 5, 0.9),
                                             region({{1, 1}}, 50, 1.3)};
  Positions expected = Positions::Zero(head(0).rows(), 3);
  for (Index k = 0; k < 2; ++k) {
    const RegionRecipe& r = regions[static_cast<std::size_t>(k)];
    Positions face = testing::evaluate(fits[0], head(0), r.iterations);  // Eq. 6
    for (const SourceWeight& source : r.weights) {
      const auto i = static_cast<std::size_t>(source.head);
      face += r.extrapolation * source.weight *
              (head(i) - testing::evaluate(fits[i], head(i), r.iterations));  // Eq. 5
    }
    expected += two_.alpha.col(k).asDiagonal() * face;
  }
  EXPECT_LT(difference(blender(fits, two_).blend(recipe(0, regions)), expected), 5e-3)
      << "patches round to steps of their own";
}

TEST_F(Blend, CubicTargetAloneGivesTheTarget) {
  const std::vector<CubicFit> fits = cubic_fits(50);
  const Recipe alone = recipe(1, {region({{1, 1}}, 20)});
  EXPECT_EQ(blender(fits, one_).blend(alone), head(1)) << "to the bit";
}

TEST_F(Blend, AChangedFaceHasTheBitsOfOneMadeAnew) {
  const std::vector<CubicFit> fits = cubic_fits(50);
  const CrowdBlender blend = blender(fits, two_);
  const RegionRecipe a = region({{0, 0.5}, {2, 0.5}}, 20, 1.1), b = region({{1, 1}}, 30);
  std::vector<Recipe> steps = {recipe(0, {a, a}), recipe(0, {b, a}), recipe(0, {b, b}),
                               recipe(1, {b, b}), recipe(1, {b, b})};
  set_target_heads(steps.back(), {{1, 0.75}, {2, 0.25}});
  Positions face = blend.blend(steps.front());
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const Positions before = face;
    blend.update(steps[i - 1], steps[i], face);
    EXPECT_EQ(face, blend.blend(steps[i])) << i;
    EXPECT_NE(face, before) << i;
  }
}

TEST_F(Blend, AFaceHasTheSameBitsAloneAndInAnyCompany) {
  const std::vector<CubicFit> fits = cubic_fits(50);
  const CrowdBlender blend = blender(fits, two_);
  std::vector<Recipe> crowd;
  for (std::uint64_t f = 0; f < 15; ++f) {  // two groups of six and a rest; sources come and go
    const double w = 0.05 * static_cast<double>(f);
    std::vector<SourceWeight> weights = {{static_cast<Index>(f % 3), 1 - w}};
    if (f > 4) weights.push_back({static_cast<Index>((f + 1) % 3), w});
    crowd.push_back(
        recipe(static_cast<Index>(f % 2), {region(weights, 3 * f, 0.9), region(weights, f)}));
  }
  std::vector<const Recipe*> all;
  for (const Recipe& one : crowd) all.push_back(&one);
  std::vector<Positions> together(15), reversed(15);
  blend.blend(all, together);
  for (std::size_t f = 0; f < crowd.size(); ++f) EXPECT_EQ(together[f], blend.blend(crowd[f])) << f;
  std::reverse(all.begin(), all.end());
  blend.blend(all, reversed);
  for (std::size_t f = 0; f < crowd.size(); ++f) EXPECT_EQ(together[f], reversed[14 - f]) << f;
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    const ThreadLimit one(1);
    EXPECT_EQ(together[7], blend.blend(crowd[7])) << name;
  }
  use_instruction_set(instruction_sets().front());
}

TEST_F(Blend, AFaceHasTheSameBitsInCompanyWhereRegionsComeInStripes) {
  RegionWeights stripes = two_;
  for (Index v = 0; v < stripes.alpha.rows(); ++v) {
    stripes.alpha.row(v) << (v % 8 < 7 ? 1 : 0), (v % 8 < 7 ? 0 : 1);
  }
  const std::vector<CubicFit> fits = cubic_fits(50);
  const CrowdBlender blend = blender(fits, stripes);
  std::vector<Recipe> crowd;
  for (std::uint64_t f = 0; f < 7; ++f) {
    crowd.push_back(recipe(static_cast<Index>(f % 3),
                           {region({{0, 0.4}, {1, 0.6}}, 5 + f, 0.9), region({{2, 1}}, 9 + f)}));
  }
  std::vector<const Recipe*> all;
  for (const Recipe& one : crowd) all.push_back(&one);
  std::vector<Positions> together(crowd.size());
  blend.blend(all, together);
  for (std::size_t f = 0; f < crowd.size(); ++f) EXPECT_EQ(together[f], blend.blend(crowd[f])) << f;
}

/// A face alone adds up its regions at once, of the heads that lend to any of those.
TEST_F(Blend, AFaceHasTheSameBitsAloneWhereManyRegionsOverlap) {
  RegionWeights five = two_;
  five.alpha.setZero(two_.alpha.rows(), 5);
  for (Index v = 0; v < five.alpha.rows(); ++v) {
    const Index count = 1 + v % 5;
    for (Index k = 0; k < count; ++k)
      five.alpha(v, (v / 7 + k) % 5) = 1.0 / static_cast<double>(count);
  }
  const std::vector<CubicFit> fits = cubic_fits(50);
  const CrowdBlender blend = blender(fits, five);
  const Recipe some = recipe(0, {region({{1, 1}}, 5, 0.9), region({{0, 1}}, 7), region({{2, 1}}, 9),
                                 region({{0, 1}}, 7), region({{1, 0.5}, {2, 0.5}}, 30, 1.1)});
  const Recipe other = recipe(1, {region({{1, 1}}, 5), region({{1, 1}}, 5), region({{1, 1}}, 5),
                                  region({{1, 1}}, 5), region({{2, 1}}, 11)});
  const std::vector<const Recipe*> both = {&some, &other};
  std::vector<Positions> together(2);
  blend.blend(both, together);
  EXPECT_NE(together[0], head(0));
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    EXPECT_EQ(together[0], blend.blend(some)) << name;
    EXPECT_EQ(together[1], blend.blend(other)) << name;
  }
  use_instruction_set(instruction_sets().front());
}

/// Heads on a finer grid, whose patches are told from few of their vertices.
class BlendPatches : public ::testing::Test {
 protected:
  BlendPatches() {
    faces_.topology = testing::grid_topology(kColumns - 1, kRows - 1);
    for (std::size_t h = 0; h < 3; ++h) {
      levels_.push_back(testing::smooth_levels(kColumns, kRows, h));
      faces_.heads.push_back({std::string(1, static_cast<char>('a' + h)),
                              testing::random_positions(kColumns * kRows, h + 1)});
    }
    std::vector<std::uint32_t> order(kColumns * kRows);
    std::iota(order.begin(), order.end(), 0U);
    patches_ = interpolate_fields(levels_, std::vector<std::uint64_t>{1, 3, 10, 30, 60}, order,
                                  kTolerance);
    regions_.alpha.setZero(kColumns * kRows, 3);
    for (Index v = 0; v < kColumns * kRows; ++v) {
      const double share = static_cast<double>(v % 10) / 10;
      regions_.alpha.row(v) << share, v / kColumns < kRows / 2 ? 1 - share : 0,
          v / kColumns < kRows / 2 ? 0 : 1 - share;
    }
    for (std::uint64_t f = 0; f < 15; ++f) {
      Recipe recipe;
      recipe.target = static_cast<Index>(f % 2);
      const double w = 0.05 * static_cast<double>(f);
      for (std::uint64_t k = 0; k < 3; ++k) {
        RegionRecipe region;
        region.weights = {{static_cast<Index>((f + k) % 3), 1 - w}};
        if (f > 4) region.weights.push_back({static_cast<Index>((f + k + 1) % 3), w});
        region.iterations = 60 - 2 * f - 10 * k;
        recipe.regions.push_back(region);
      }
      recipes_.push_back(recipe);
    }
    set_target_heads(recipes_.back(), {{0, 0.25}, {2, 0.75}});
    for (const Recipe& recipe : recipes_) pointers_.push_back(&recipe);
  }
  /// Every field of every head, vertex by vertex.
  Positions added_up(const Recipe& recipe) const {
    Positions sum = target_positions(faces_, recipe);
    for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
      for (const LevelWeights& at : weights_by_level(recipe, k)) {
        for (const SourceWeight& part : at.weights) {
          const HeadSmoothing& head = levels_[static_cast<std::size_t>(part.head)];
          const std::vector<double> functions = head.functions(at.level);
          for (Index v = 0; v < sum.rows(); ++v) {
            for (std::size_t p = 0; p < functions.size(); ++p) {
              for (Index c = 0; c < 3; ++c) {
                sum(v, c) += regions_.alpha(v, static_cast<Index>(k)) * part.weight * functions[p] *
                             head.fields.value(static_cast<Index>(p), v, c);
              }
            }
          }
        }
      }
    }
    return sum;
  }

  static constexpr Index kColumns = 40, kRows = 31;
  static constexpr double kTolerance = 0.01;
  HeadSet faces_;
  std::vector<HeadSmoothing> levels_;
  FieldPatches patches_;
  RegionWeights regions_;
  std::vector<Recipe> recipes_;
  std::vector<const Recipe*> pointers_;
};

TEST_F(BlendPatches, AreAsNearToAllFieldsAsTheToleranceSays) {
  const CrowdBlender blend(faces_, levels_, patches_, regions_);
  for (std::size_t i = 0; i < patches_.size(); ++i)
    EXPECT_FALSE(patches_[i].stores_all_vertices()) << i;
  double most = 0;
  for (const Recipe& recipe : recipes_) {
    const Positions missed = blend.blend(recipe) - added_up(recipe);
    most = std::max(most, missed.rowwise().norm().maxCoeff());
  }
  EXPECT_LT(most, 2 * kTolerance) << "the target's levels and the sources'";
  EXPECT_GT(most, 1e-5) << "nothing was interpolated";
}

TEST_F(BlendPatches, AFaceHasTheSameBitsAloneAndInAnyCompany) {
  const CrowdBlender blend(faces_, levels_, patches_, regions_);
  std::vector<Positions> together(recipes_.size());
  blend.blend(pointers_, together);
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    for (std::size_t f = 0; f < recipes_.size(); ++f) {
      EXPECT_EQ(together[f], blend.blend(recipes_[f])) << name << ' ' << f;
    }
    std::vector<Positions> some(7);
    blend.blend(std::span(pointers_).subspan(8), some);
    for (std::size_t f = 0; f < some.size(); ++f) EXPECT_EQ(together[8 + f], some[f]) << name;
  }
  use_instruction_set(instruction_sets().front());
}

TEST_F(BlendPatches, AFaceThatIsItsTargetKeepsItsBits) {
  const CrowdBlender blend(faces_, levels_, patches_, regions_);
  Recipe alone = recipes_[0];
  for (RegionRecipe& region : alone.regions) region.weights = {{alone.target, 1}};
  EXPECT_EQ(blend.blend(alone), faces_.heads[0].positions);
}

TEST_F(BlendPatches, ChangingOneRegionGivesTheBitsOfBlending) {
  const CrowdBlender blend(faces_, levels_, patches_, regions_);
  Recipe after = recipes_[0];
  after.regions[2].iterations = 7;
  Positions face = blend.blend(recipes_[0]);
  blend.update(recipes_[0], after, face);
  EXPECT_EQ(face, blend.blend(after));
}

TEST_F(Blend, RimsKeepTheTargetsBitsWithFittedLevels) {
  const std::vector<CubicFit> fits = cubic_fits(50);
  const Positions face =
      blender(fits, two_).blend(recipe(2, {region({{0, 1}}, 17, 1.4), region({{1, 1}}, 30)}));
  const Adjacency adjacency = build_adjacency(faces_.topology);
  for (Index i = 0; i < face.rows(); ++i) {
    if (!adjacency.boundary[static_cast<std::size_t>(i)]) continue;
    EXPECT_EQ(face.row(i), head(2).row(i));
  }
}

TEST_F(Blend, RecipesThatDoNotFitAreRefused) {
  const auto refuse = [&](const Recipe& bad, const RegionWeights& regions) {
    EXPECT_THROW(blend_exact(faces_, filter(), regions, bad), BrokenPrecondition);
    const std::vector<CubicFit> fits = cubic_fits(5);
    EXPECT_THROW(blender(fits, regions).blend(bad), BrokenPrecondition);
  };
  refuse(recipe(0, {region({{1, 1}}, 3)}), two_);
  refuse(recipe(3, {region({{1, 1}}, 3)}), one_);
  refuse(recipe(-1, {region({{1, 1}}, 3)}), one_);
  refuse(recipe(0, {region({{3, 1}}, 3)}), one_);
  RegionWeights shorter;
  shorter.alpha = RegionWeights::Alpha::Ones(5, 1);
  refuse(recipe(0, {region({{1, 1}}, 3)}), shorter);
}

TEST_F(Blend, LevelsAreNeededForEachHead) {
  std::vector<CubicFit> fits = cubic_fits(5);
  fits.pop_back();
  EXPECT_THROW(blender(fits, one_), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
