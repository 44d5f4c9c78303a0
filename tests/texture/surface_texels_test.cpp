// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/surface_texels.h"

#include <gtest/gtest.h>

#include "texture/two_charts.h"

namespace crowdface {
namespace {

using testing::TwoCharts;

TEST(SurfaceTexels, CoverEachChartOnceWithSharesThatSumToThePlace) {
  const TwoCharts sheet(256);
  const SurfaceTexels texels = sheet.texels();
  EXPECT_NEAR(static_cast<double>(texels.covered_texel_count()), 0.8 * 0.8 * 256 * 256, 1500);
  std::size_t covered = 0;
  double farthest = 0;
  for (int y = 0; y < texels.height(); ++y) {
    int end = 0;
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      EXPECT_GE(span.begin, end);
      end = span.end;
      covered += static_cast<std::size_t>(span.end - span.begin);
      const SurfaceTexels::Triangle& triangle = texels.triangle(span.triangle);
      for (int x = span.begin; x < span.end; ++x) {
        const double b = double{triangle.second_barycentric[0]} +
                         x * double{triangle.second_barycentric[1]} +
                         y * double{triangle.second_barycentric[2]};
        const double c = double{triangle.third_barycentric[0]} +
                         x * double{triangle.third_barycentric[1]} +
                         y * double{triangle.third_barycentric[2]};
        const auto place = [&](std::size_t corner) -> Eigen::RowVector2d {
          const std::uint32_t v = texels.vertices()[triangle.corners[corner]];
          return Eigen::RowVector2d(v % (TwoCharts::kSide + 1), v / (TwoCharts::kSide + 1)) /
                 TwoCharts::kSide;
        };
        const Eigen::RowVector2d found = (1 - b - c) * place(0) + b * place(1) + c * place(2);
        const auto [wanted_x, wanted_y] = TwoCharts::from_uv((x + 0.5) / 256, 1 - (y + 0.5) / 256);
        farthest = std::max(farthest, (found - Eigen::RowVector2d(wanted_x, wanted_y)).norm());
      }
    }
  }
  EXPECT_EQ(covered, texels.covered_texel_count());
  EXPECT_LT(farthest, 1e-3) << "a fifth of a texel";
}

TEST(SurfaceTexels, TheGutterTakesCoveredTexelsAndIsNoneItself) {
  const TwoCharts sheet(128);
  const SurfaceTexels texels = sheet.texels();
  std::vector<bool> covered(128 * 128);
  for (int y = 0; y < 128; ++y) {
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      for (int x = span.begin; x < span.end; ++x)
        covered[static_cast<std::size_t>(128 * y + x)] = true;
    }
  }
  ASSERT_FALSE(texels.gutter().empty());
  for (const SurfaceTexels::GutterTexel& texel : texels.gutter()) {
    EXPECT_FALSE(covered[texel.target]);
    EXPECT_TRUE(covered[texel.source]);
  }
}

}  // namespace
}  // namespace crowdface
