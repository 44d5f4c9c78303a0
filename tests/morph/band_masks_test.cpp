// SPDX-License-Identifier: Apache-2.0
#include "crowdface/morph/band_masks.h"

#include <array>

#include <gtest/gtest.h>

#include "crowdface/core/require.h"

#include "support/expect_error.h"
#include "support/meshes.h"

namespace crowdface::testing {
namespace {

/// A sheet from y = 0 to 10 whose texture fills the left half of tile 1001 and all of tile 1002.
Mesh two_tiles() {
  Mesh mesh;
  mesh.topology = make_topology(6, {{0, 1, 3, 2}, {0, 1, 5, 4}});
  mesh.topology.corner_uvs = {0, 1, 2, 3, 4, 5, 6, 7};
  mesh.positions.resize(6, 3);
  mesh.positions << 0, 0, 0, 1, 0, 0, 0, 10, 0, 1, 10, 0, 0, 10, 0, 1, 10, 0;
  mesh.uvs.resize(8, 2);
  mesh.uvs << 0, 0, 0.5, 0, 0.5, 1, 0, 1, 1, 0, 2, 0, 2, 1, 1, 1;
  return mesh;
}

TEST(BandMasks, OneTileEachAndEveryPaintedPixelAddsUp) {
  constexpr int kSize = 64;
  const auto tiles = band_masks(two_tiles(), {5, 3}, kSize);
  ASSERT_EQ(tiles.size(), 2U);
  const auto at = [&](int tile, int x, int y) {
    const auto i = static_cast<std::size_t>(3 * (y * kSize + x));
    const auto& p = tiles.at(tile);
    return std::array<int, 3>{p[i], p[i + 1], p[i + 2]};
  };
  using Pixel = std::array<int, 3>;
  for (const int tile : {1001, 1002}) {
    EXPECT_EQ(at(tile, 5, 2), (Pixel{255, 0, 0})) << "the first row is the top";
    EXPECT_EQ(at(tile, 5, 35), (Pixel{0, 255, 0})) << "between eyes and mouth";
    EXPECT_EQ(at(tile, 5, 60), (Pixel{0, 0, 255}));
    for (int y = 0; y < kSize; ++y) {
      const Pixel p = at(tile, 20, y);
      EXPECT_EQ(p[0] + p[1] + p[2], 255);
    }
  }
  EXPECT_EQ(at(1001, 35, 2), (Pixel{255, 0, 0})) << "some way beyond the border";
  EXPECT_EQ(at(1001, 50, 2), (Pixel{0, 0, 0})) << "nothing far away";
}

TEST(BandMasks, WhereFacesShareAPlaceTheFirstCounts) {
  Mesh mesh = two_tiles();
  mesh.topology.corner_uvs = {0, 1, 2, 3, 3, 2, 1, 0};  // the other way up, over the first
  const auto tiles = band_masks(mesh, {5, 3}, 64);
  ASSERT_EQ(tiles.size(), 1U);
  EXPECT_EQ(tiles.at(1001)[3 * (64 * 2 + 5)], 255);
}

TEST(BandMasks, WhatCannotBePaintedIsRefused) {
  EXPECT_THROW(band_masks(two_tiles(), {5, 3}, 0), BrokenPrecondition);
  expect_error(ExitCode::kBadData, {"eyes above the mouth"}, [] {
    band_masks(two_tiles(), {3, 3}, 8);
  });
  Mesh bare = two_tiles();
  bare.topology.corner_uvs.clear();
  expect_error(ExitCode::kBadData, {"texture coordinates"}, [&] { band_masks(bare, {5, 3}, 8); });
}

}  // namespace
}  // namespace crowdface::testing
