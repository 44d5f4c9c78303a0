// SPDX-License-Identifier: Apache-2.0
#include "multiscale_faces/multiscale_face.h"

#include <gtest/gtest.h>

#include "crowdface/core/require.h"

#include "multiscale_faces/comparison.h"
#include "multiscale_faces/heads_under_test.h"

namespace crowdface::multiscale {
namespace {

std::vector<double> all_levels(double weight) {
  return std::vector<double>(kLevelCount - 1, weight);
}

TEST(MultiscaleFace, IsMadeAgainFromItsOwnMaps) {
  const TestHeads heads;
  const MultiscaleFace face = multiscale_face(heads.patch, heads.fronts[0], 2);
  const auto error = [&](double weight) {
    const WeightedSource own{&face, std::vector<double>(face.displacements.size(), weight)};
    return differences(heads.patch, heads.fronts[0], synthesize(face, {&own, 1}))
        .rms_distance_to_surface;
  };
  // In centimetres. Without displacements, only the base surface is left.
  EXPECT_LT(error(1), 0.05);
  EXPECT_GT(error(0), 4 * error(1));
  EXPECT_LT(face.missed_sample_fraction, 0.01);
}

TEST(MultiscaleFace, IsLinearInTheWeightsOfDetails) {
  const TestHeads heads;
  const MultiscaleFace a = multiscale_face(heads.patch, heads.fronts[0], 0),
                       b = multiscale_face(heads.patch, heads.fronts[1], 0);
  const auto face = [&](double of_a, double of_b) {
    const std::vector<WeightedSource> details = {{&a, all_levels(of_a)}, {&b, all_levels(of_b)}};
    return synthesize(a, details);
  };
  const Positions middle = face(0.5, 0.5);
  EXPECT_NEAR((middle - (face(1, 0) + face(0, 1)) / 2).rowwise().norm().maxCoeff(), 0, 1e-9);
  // Weights of vertices do the same.
  const std::vector<double> half(static_cast<std::size_t>(heads.patch.vertex_count()), 0.5);
  const std::vector<WeightedSource> details = {{&a, all_levels(1), half},
                                               {&b, all_levels(1), half}};
  EXPECT_NEAR((synthesize(a, details) - middle).rowwise().norm().maxCoeff(), 0, 1e-9);
}

TEST(MultiscaleFace, RefusesDetailsOfAnotherBase) {
  const TestHeads heads;
  const MultiscaleFace a = multiscale_face(heads.patch, heads.fronts[0], 0);
  const MultiscaleFace b = with_base_level(a, 1);
  const WeightedSource other{&b, all_levels(1)};
  EXPECT_THROW(synthesize(a, {&other, 1}), BrokenPrecondition);
}

TEST(LargestNewCrease, SeesAFoldThatNoHeadHas) {
  const TestHeads heads;
  const std::vector<bool> everywhere(static_cast<std::size_t>(heads.patch.vertex_count()), true);
  EXPECT_EQ(largest_new_crease(heads.patch, heads.fronts[0], heads.fronts, everywhere), 0);
  Positions folded = heads.fronts[0];
  folded.row(heads.patch.vertex_count() / 2) += Eigen::RowVector3d(0, 0, 1);
  EXPECT_GT(largest_new_crease(heads.patch, folded, heads.fronts, everywhere), 20);
}

TEST(BandEnergies, OfASmoothedHeadAreSmallerInFineBands) {
  const SyntheticHeads made(6000);
  const Positions head = 10 * made.positions(1, 0);
  const FrontPatch patch = front_patch(made.topology(), head, {1, 1}, {2, 1});
  const std::vector<double> bounds = {16, 32, 64};
  const std::vector<double> whole = band_energies(made.topology(), patch, head, bounds);
  ASSERT_EQ(whole.size(), 3U);
  for (const double energy : whole) EXPECT_GT(energy, 0);
  EXPECT_LT(whole[0], whole[2]);
}

}  // namespace
}  // namespace crowdface::multiscale
