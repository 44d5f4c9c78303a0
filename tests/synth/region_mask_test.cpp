// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/core/require.h"
#include "head_models/synth/layout.h"
#include "head_models/synth/synthetic_head.h"

namespace crowdface {
namespace {

constexpr int kMaskSize = 256;

std::array<double, 3> at(const std::vector<std::uint8_t>& mask, double u, double v) {
  const int x = std::clamp(static_cast<int>(u * kMaskSize), 0, kMaskSize - 1);
  const int y = std::clamp(static_cast<int>((1 - v) * kMaskSize), 0, kMaskSize - 1);
  const std::size_t i = static_cast<std::size_t>(y * kMaskSize + x) * 3;
  return {mask[i] / 255.0, mask[i + 1] / 255.0, mask[i + 2] / 255.0};
}

TEST(RegionMask, CoversEveryPixelOnce) {
  const auto mask = synthetic_region_mask(kMaskSize);
  ASSERT_EQ(mask.size(), static_cast<std::size_t>(kMaskSize) * kMaskSize * 3);
  for (std::size_t i = 0; i < mask.size(); i += 3) {
    ASSERT_EQ(mask[i] + mask[i + 1] + mask[i + 2], 255);
  }
}

TEST(RegionMask, BandsLieOneAboveTheOther) {
  const SyntheticHeads heads(5000);
  const auto mask = synthetic_region_mask(kMaskSize);
  const Positions positions = heads.positions(1, 0);
  std::array<double, 3> height{}, weight{};
  int soft = 0;
  const Topology& topology = heads.topology();
  for (std::size_t c = 0; c < topology.corner_vertices.size(); ++c) {
    const auto uv = heads.uvs().row(topology.corner_uvs[c]);
    const Eigen::RowVector3d p = positions.row(topology.corner_vertices[c]);
    const auto bands = at(mask, uv.x(), uv.y());
    soft += *std::max_element(bands.begin(), bands.end()) < 0.9 ? 1 : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      height[k] += bands[k] * p.y();
      weight[k] += bands[k];
    }
  }
  for (const double w : weight) EXPECT_GT(w, 0.1 * weight[0]);
  EXPECT_GT(soft, 100);  // the bands run into one another
  EXPECT_GT(height[0] / weight[0], height[1] / weight[1] + 3);
  EXPECT_GT(height[1] / weight[1], height[2] / weight[2] + 3);
}

TEST(RegionMask, NoseIsMiddleMouthIsBottomForeheadIsTop) {
  const synth::Layout layout = synth::make_layout(5000);
  const auto mask = synthetic_region_mask(kMaskSize);
  for (std::size_t c = 0; c < layout.topology.corner_vertices.size(); ++c) {
    const synth::LatticePoint& a = layout.lattice_points[layout.topology.corner_vertices[c]];
    const auto uv = layout.uvs.row(layout.topology.corner_uvs[c]);
    const auto bands = at(mask, uv.x(), uv.y());
    if (a.patch == synth::SkinPatch::kNostril) {
      EXPECT_GT(bands[1], 0.5);
    }
    if (a.patch == synth::SkinPatch::kMouth && a.b >= 1) {
      EXPECT_GT(bands[2], 0.9);
    }
    if (a.patch == synth::SkinPatch::kCap) {
      EXPECT_EQ(bands[0], 1);
    }
  }
}

TEST(RegionMask, RefusesNoSize) {
  EXPECT_THROW(synthetic_region_mask(0), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
