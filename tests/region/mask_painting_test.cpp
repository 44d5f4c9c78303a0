// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/mask_painting.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/file.h"
#include "crowdface/core/require.h"
#include "crowdface/core/smooth_step.h"

#include "support/expect_error.h"
#include "support/meshes.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

/// A sheet from y = 0 to 10 whose texture fills the left half of tile 1001 and all of tile 1002.
Mesh two_tiles() {
  Mesh mesh;
  mesh.topology = make_topology(6, {{0, 1, 3, 2}, {0, 1, 5, 4}});
  mesh.topology.corner_uvs = {0, 1, 2, 3, 4, 5, 6, 7};
  mesh.uvs.resize(8, 2);
  mesh.uvs << 0, 0, 0.5, 0, 0.5, 1, 0, 1, 1, 0, 2, 0, 2, 1, 1, 1;
  return mesh;
}

/// First region below, second above.
RegionWeights::Alpha from_below() {
  RegionWeights::Alpha alpha(6, 2);
  alpha << 1, 0, 1, 0, 0, 1, 0, 1, 0, 1, 0, 1;
  return alpha;
}

TEST(MaskPainting, EveryPaintedTexelAddsUpAndTheFirstRowIsTheTop) {
  constexpr int kSize = 64;
  const PaintedMasks masks =
      paint_masks(two_tiles().topology, two_tiles().uvs, from_below(), {}, kSize);
  ASSERT_EQ(masks.images_by_tile.size(), 2U);
  EXPECT_TRUE(masks.is_tiled());
  const auto at = [&](int tile, int x, int y) {
    const auto i = static_cast<std::size_t>(3 * (y * kSize + x));
    const auto& p = masks.images_by_tile.at(tile).at(0);
    return std::array<int, 3>{p[i], p[i + 1], p[i + 2]};
  };
  for (const int tile : {1001, 1002}) {
    EXPECT_GT(at(tile, 5, 2)[1], 240);
    EXPECT_GT(at(tile, 5, 61)[0], 240);
    for (int y = 0; y < kSize; ++y) {
      const auto p = at(tile, 20, y);
      EXPECT_EQ(p[0] + p[1], 255);
      EXPECT_EQ(p[2], 0);
    }
  }
  EXPECT_GT(at(1001, 35, 2)[1], 240) << "some way beyond the chart's border";
  EXPECT_EQ(at(1001, 50, 2), (std::array<int, 3>{0, 0, 0})) << "nothing far away";
}

/// A sheet whose two halves lie apart in the texture, the second in another tile, with five regions
/// that run into one another.
TEST(MaskPainting, ReadsBackAsItWasPaintedOverSeamsAndTiles) {
  constexpr std::uint32_t kSide = 40;
  HeadSet sheet;
  sheet.topology = grid_topology(kSide, kSide);
  sheet.uvs.resize(2 * sheet.topology.vertex_count, 2);
  RegionWeights::Alpha alpha(sheet.topology.vertex_count, 5);
  for (Index v = 0; v < sheet.topology.vertex_count; ++v) {
    const double x = static_cast<double>(v % (kSide + 1)) / kSide;
    const double y = static_cast<double>(v / (kSide + 1)) / kSide;
    sheet.uvs.row(v) << 0.05 + 0.8 * x, 0.1 + 0.8 * y;
    sheet.uvs.row(sheet.topology.vertex_count + v) << 1.9 - 0.8 * y, 0.1 + 0.7 * x;
    const double a = smooth_step(0.1, 0.9, x), b = smooth_step(0.2, 0.8, y);
    alpha.row(v) << a * b, a * (1 - b), (1 - a) * b, (1 - a) * (1 - b) * x,
        (1 - a) * (1 - b) * (1 - x);
  }
  for (Index f = 0; f < sheet.topology.face_count(); ++f) {
    const bool left = f % kSide < kSide / 2;
    for (const std::uint32_t v : sheet.topology.face(f)) {
      const auto other = static_cast<std::uint32_t>(sheet.topology.vertex_count) + v;
      sheet.topology.corner_uvs.push_back(left ? v : other);
    }
  }
  const TemporaryFolder folder;
  const MaskFiles masks = encode_masks(paint_masks(sheet.topology, sheet.uvs, alpha, {}, 256),
                                       folder.path() / "mask.png");
  EXPECT_THAT(masks.mask_paths, ::testing::ElementsAre(folder.path() / "mask.<UDIM>.png",
                                                       folder.path() / "mask_2.<UDIM>.png"));
  std::vector<MaskSource> sources;
  for (const auto& mask : masks.mask_paths) sources.emplace_back(mask.string());
  for (const auto& [file, bytes] : masks.png_files) write_file(file, bytes);
  const auto read = region_weights(sheet.topology, sheet.uvs, sources, 5);
  EXPECT_EQ(read.uncovered_vertex_count, 0);
  EXPECT_LT((read.alpha - alpha).cwiseAbs().maxCoeff(), 2.0 / 255);
}

TEST(MaskPainting, WhereFacesShareAPlaceTheFirstCounts) {
  Mesh mesh = two_tiles();
  mesh.topology.corner_uvs = {0, 1, 2, 3, 3, 2, 1, 0};  // the other way up, over the first
  const auto red_on_top = [&](const std::vector<bool>& first) {
    const PaintedMasks masks = paint_masks(mesh.topology, mesh.uvs, from_below(), first, 64);
    EXPECT_FALSE(masks.is_tiled());
    return masks.images_by_tile.at(1001)[0][3 * (64 * 10 + 5)];
  };
  EXPECT_LT(red_on_top({true, true, true, true, false, false}), 100);
  EXPECT_EQ(encode_masks(paint_masks(mesh.topology, mesh.uvs, from_below(), {}, 8), "a/m.png")
                .mask_paths.at(0),
            "a/m.png");
}

TEST(MaskPainting, WhatCannotBePaintedIsRefused) {
  Mesh mesh = two_tiles();
  EXPECT_THROW(paint_masks(mesh.topology, mesh.uvs, from_below(), {}, 0), BrokenPrecondition);
  mesh.topology.corner_uvs[2] = kNoIndex;
  expect_error(ExitCode::kBadData, {"texture coordinate"},
               [&] { paint_masks(mesh.topology, mesh.uvs, from_below(), {}, 8); });
  mesh.topology.corner_uvs.clear();
  expect_error(ExitCode::kBadData, {"texture coordinates"},
               [&] { paint_masks(mesh.topology, mesh.uvs, from_below(), {}, 8); });
}

}  // namespace
}  // namespace crowdface::testing
