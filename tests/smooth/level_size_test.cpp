// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/level_size.h"

#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/smooth/iterate.h"

#include "support/expect_error.h"
#include "support/meshes.h"

namespace crowdface {
namespace {

TEST(LevelSize, HalvesWavesOfThatLength) {
  // A wave along a long strip, free at its ends; its amplitude in the middle after the level.
  for (const OperatorKind kind : {OperatorKind::kUmbrella, OperatorKind::kLazy}) {
    constexpr std::uint32_t kWidth = 400;
    const Topology topology = testing::grid_topology(kWidth, 40);
    const SmoothingOperator smoothing(build_adjacency(topology), Boundary::kFree, kind);
    constexpr double kEdge = 0.7, kWavelength = 40 * kEdge;
    const std::uint64_t level = iterations_for_wavelength(kind, kWavelength, kEdge);
    Positions wave = Positions::Zero(topology.vertex_count, 3);
    for (Index i = 0; i < wave.rows(); ++i) {
      wave(i, 2) = std::cos(2 * 3.14159265358979 * kEdge *
                            (static_cast<double>(i % (kWidth + 1)) - kWidth / 2) / kWavelength);
    }
    const Columns smoothed = iterate(smoothing, wave, level);
    const Index middle = 20 * (kWidth + 1) + kWidth / 2;
    EXPECT_NEAR(smoothed(middle, 2), 0.5, 0.01);
  }
}

TEST(LevelSize, InvertsUpToRounding) {
  const std::uint64_t level = iterations_for_wavelength(OperatorKind::kUmbrella, 240, 2.1);
  EXPECT_NEAR(wavelength_of_iterations(OperatorKind::kUmbrella, level, 2.1), 240, 0.1);
  // The lazy operator needs twice as many.
  EXPECT_NEAR(static_cast<double>(iterations_for_wavelength(OperatorKind::kLazy, 240, 2.1)),
              2.0 * static_cast<double>(level), 1);
}

TEST(LevelSize, OfThePaperIs240Millimetres) {
  // 20,000 iterations at 1.2 million vertices, where edges are about 0.45 mm (design notes).
  EXPECT_NEAR(wavelength_of_iterations(OperatorKind::kUmbrella, 20000, 0.45), 240, 1);
}

TEST(LevelSize, RefusesWhatHasNoSize) {
  testing::expect_error(ExitCode::kBadData, {"positive"},
                        [] { iterations_for_wavelength(OperatorKind::kLazy, 0, 1); });
  testing::expect_error(ExitCode::kBadData, {"10^9"},
                        [] { iterations_for_wavelength(OperatorKind::kLazy, 1e9, 1e-3); });
}

}  // namespace
}  // namespace crowdface
