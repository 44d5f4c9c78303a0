// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/uv_samples.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two quads side by side, u from 0 to 2, that share the texture coordinates of their common edge.
struct TwoTiles {
  Topology topology = {6, {0, 1, 4, 3, 1, 2, 5, 4}, {0, 1, 4, 3, 1, 2, 5, 4}, {0, 4, 8}};
  TextureCoordinates uvs =
      (TextureCoordinates(6, 2) << 0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1).finished();
};

std::string message_of_uvs(const Topology& topology, const TextureCoordinates& uvs,
                           UvTiling tiling) {
  try {
    gather_uv_samples(topology, uvs, tiling, {}, "ann.obj");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TileStep, IsTheWholePartExceptOnABorder) {
  EXPECT_EQ(tile_index(0.25, 3), 0);
  EXPECT_EQ(tile_index(2.75, 0), 2);
  EXPECT_EQ(tile_index(1.0, 0.9), 0);
  EXPECT_EQ(tile_index(1.0, 1.1), 1);
  EXPECT_EQ(tile_index(0.0, 0.5), 0);
}

TEST(TileStep, RoundingErrorsStayInThePolygonsTile) {
  EXPECT_EQ(tile_index(-1e-6, 0.5), 0);
  EXPECT_EQ(tile_index(-1e-6, -5e-7), 0);
  EXPECT_EQ(tile_index(1.00009, 0.9), 0);
  EXPECT_EQ(tile_index(0.99991, 1.1), 1);
  EXPECT_EQ(tile_index(10.00001, 9.5), 9);
  EXPECT_EQ(tile_index(1.001, 0.9), 1);
  EXPECT_EQ(tile_index(-0.001, 0.5), -1);
  EXPECT_EQ(tile_index(1.00001, 4.5), 1) << "the mean lies in another tile";
}

TEST(TileNumber, CountsTenColumnsARow) {
  EXPECT_EQ(tile_number(0, 0), 1001);
  EXPECT_EQ(tile_number(9, 0), 1010);
  EXPECT_EQ(tile_number(2, 3), 1033);
  EXPECT_EQ(tile_number(8, 899), 9999);
  EXPECT_THROW(tile_number(9, 899), InvalidInput) << "five digits, which no file's name has";
  EXPECT_THROW(tile_number(10, 0), InvalidInput);
  EXPECT_THROW(tile_number(-1, 0), InvalidInput);
  EXPECT_THROW(tile_number(0, -1), InvalidInput);
}

TEST(UvSamples, PolygonDecidesTheTileOnABorder) {
  const TwoTiles mesh;
  const UvSamples samples = gather_uv_samples(mesh.topology, mesh.uvs, UvTiling::kUdim);
  EXPECT_THAT(tiles_of(samples), ElementsAre(1001, 1002));
  EXPECT_THAT(samples.items_of(0), ElementsAre(UvSample{1001, 0, 0}));
  EXPECT_THAT(samples.items_of(5), ElementsAre(UvSample{1002, 2, 1}));  // v = 1 is its tile's top
  EXPECT_THAT(samples.items_of(4), ElementsAre(UvSample{1001, 1, 1}, UvSample{1002, 1, 1}));
}

TEST(UvSamples, OnePictureHasOnePlaceAValue) {
  TwoTiles mesh;
  // The same value twice in the list is still one place.
  mesh.uvs.conservativeResize(7, 2);
  mesh.uvs.row(6) = mesh.uvs.row(1);
  mesh.topology.corner_uvs[4] = 6;
  const UvSamples samples = gather_uv_samples(mesh.topology, mesh.uvs, UvTiling::kOne);
  EXPECT_THAT(samples.items_of(1), ElementsAre(UvSample{1001, 1, 0}));
  EXPECT_EQ(samples.items.size(), 6U);
}

TEST(UvSamples, SeamVertexHasTwoPlaces) {
  TwoTiles mesh;
  mesh.uvs.conservativeResize(7, 2);
  mesh.uvs.row(6) << 0.5, 0.25;
  mesh.topology.corner_uvs[4] = 6;
  EXPECT_THAT(gather_uv_samples(mesh.topology, mesh.uvs, UvTiling::kOne).items_of(1),
              ElementsAre(UvSample{1001, 0.5, 0.25}, UvSample{1001, 1, 0}));
}

TEST(UvSamples, IsolatedVertexHasNone) {
  TwoTiles mesh;
  mesh.topology.vertex_count = 7;
  EXPECT_TRUE(gather_uv_samples(mesh.topology, mesh.uvs, UvTiling::kUdim).items_of(6).empty());
}

TEST(UvSamples, MissingCoordinatesAreNamed) {
  TwoTiles mesh;
  mesh.topology.corner_uvs[5] = kNoIndex;
  EXPECT_THAT(
      message_of_uvs(mesh.topology, mesh.uvs, UvTiling::kUdim),
      HasSubstr(
          "ann.obj: masks need texture coordinates: vertex 3 of face 2 has no texture coordinate"));
  mesh.topology.corner_uvs[5] = 2;
  mesh.topology.corner_uvs[1] = kNoIndex;  // vertex 2 still has one in face 2
  EXPECT_EQ(message_of_uvs(mesh.topology, mesh.uvs, UvTiling::kUdim), "accepted");
  mesh.topology.corner_uvs.clear();
  EXPECT_THAT(message_of_uvs(mesh.topology, mesh.uvs, UvTiling::kOne),
              HasSubstr("vertex 1 of face 1 has no texture coordinate"));
}

TEST(UvSamples, UnusableCoordinatesAreRefused) {
  TwoTiles mesh;
  mesh.uvs(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(gather_uv_samples(mesh.topology, mesh.uvs, UvTiling::kOne), BrokenPrecondition);
  mesh.uvs(3, 1) = -0.5;
  EXPECT_THAT(
      message_of_uvs(mesh.topology, mesh.uvs, UvTiling::kUdim),
      HasSubstr(
          "ann.obj: vertex 4, texture coordinate 0, -0.5: expected texture coordinates inside "
          "the UDIM tiles"));
  EXPECT_EQ(message_of_uvs(mesh.topology, mesh.uvs, UvTiling::kOne), "accepted");
  mesh.topology.corner_uvs[0] = 6;
  EXPECT_THROW(gather_uv_samples(mesh.topology, mesh.uvs, UvTiling::kOne), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
