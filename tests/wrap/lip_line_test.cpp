// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/lip_line.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace crowdface::testing {
namespace {

/// A scan whose surface has the depth `front(height)` in mm, seen from the front (+z).
Scan relief_of_heights(const std::function<double(double)>& front) {
  constexpr int kColumns = 61, kRows = 201;
  Scan scan;
  scan.positions.resize(kColumns * kRows, 3);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double up = (row - kRows / 2) * 0.5;
      scan.positions.row(row * kColumns + column) << column - kColumns / 2, up, front(up);
      if (row == 0 || column == 0) continue;
      const auto here = static_cast<std::uint32_t>(row * kColumns + column);
      const std::uint32_t below = here - kColumns;
      scan.triangles.push_back({below - 1, below, here});
      scan.triangles.push_back({below - 1, here, here - 1});
    }
  }
  return scan;
}

/// The scan's line between the lips, seen from a line at height 0.
std::optional<ScanLipLine> line_of(const Scan& scan) {
  WrapTemplate wrap_template;
  wrap_template.axes = {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitY()};
  Positions wrapped(62, 3);
  LipLine line;
  for (std::uint32_t i = 0; i < 31; ++i) {
    const double across = static_cast<double>(i) - 15;
    wrapped.row(2 * i) << across, 1.5, 0;
    wrapped.row(2 * i + 1) << across, -1.5, 0;
    const auto vertex = [](std::uint32_t v) { return SurfacePoint{{v, v, v}, {1, 0, 0}}; };
    line.push_back({vertex(2 * i), vertex(2 * i + 1)});
  }
  return find_scan_lip_line(wrap_template, line, wrapped, scan, {});
}

TEST(LipLine, IsTheClearestCreaseNearTheMouth) {
  for (const double height : {-9.0, 0.0, 4.0}) {
    const auto line =
        line_of(relief_of_heights([&](double up) { return std::abs(up - height) <= 1 ? -2 : 0; }));
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->offset_mm, height, 0.51);
    EXPECT_TRUE(line->is_closed);
  }
  EXPECT_FALSE(line_of(relief_of_heights([](double) { return 0; }))) << "no crease";
}

// The gap of an open mouth is no crease. The nostrils were taken for the line between the lips.
TEST(LipLine, IsUnknownIfTheMouthIsOpen) {
  const auto line = line_of(relief_of_heights([](double up) {
    if (std::abs(up) <= 4) return -20.0;
    return std::abs(up - 15) <= 1 ? -2.5 : 0.0;
  }));
  EXPECT_FALSE(line);
}

TEST(LipLine, LipsThatAreAFewMillimetresApartAreNotClosed) {
  const auto line =
      line_of(relief_of_heights([](double up) { return std::abs(up) <= 1.5 ? -20 : 0; }));
  ASSERT_TRUE(line);
  EXPECT_FALSE(line->is_closed);
}

}  // namespace
}  // namespace crowdface::testing
