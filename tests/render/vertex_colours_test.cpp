// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/vertex_colours.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "render/shapes.h"

namespace crowdface {
namespace {

TEST(PaletteColours, AreToldApart) {
  for (Eigen::Index k = 0; k < 4; ++k) {
    for (Eigen::Index other = 0; other < k; ++other) {
      EXPECT_GT((palette_colour(k) - palette_colour(other)).norm(), 0.2F);
    }
  }
}

TEST(RegionColours, AVertexOfSeveralRegionsHasTheirMixture) {
  VertexColours colours(2, 3);
  colours << 1, 0, 0, 0, 0.5F, 1;
  const Eigen::MatrixXd alpha{{1, 0}, {0, 1}, {0.5, 0.5}};
  const VertexColours expected{{1, 0, 0}, {0, 0.5F, 1}, {0.5F, 0.25F, 0.5F}};
  EXPECT_TRUE(region_colours(alpha, colours).isApprox(expected));
}

TEST(MaskColours, GoFromClayToTheRegionsColour) {
  const Eigen::Vector3f colour(1, 0, 0);
  const VertexColours colours = mask_colours(Eigen::Vector3d(0, 0.5, 1), colour);
  EXPECT_TRUE(colours.row(2).transpose().isApprox(colour));
  EXPECT_TRUE(colours.row(1).isApprox((colours.row(0) + colours.row(2)) / 2));
  EXPECT_GT(colours(0, 2), 0.5F);
}

TEST(EyeCoordinates, AreRadiiOfEachEyeballAsSeenFromTheFront) {
  // Two eyeballs of radius 2 and 3, and a ball of skin.
  const Mesh eyes = join_meshes(make_sphere(2), make_sphere(3), {10, 1, 0});
  const Mesh mesh = join_meshes(eyes, make_sphere(1), {0, 9, 0});
  Surfaces surfaces;
  surfaces.kinds.assign(static_cast<std::size_t>(mesh.topology.face_count()), SurfaceKind::kSkin);
  std::fill_n(surfaces.kinds.begin(), eyes.topology.face_count(), SurfaceKind::kEye);
  const auto found = eye_coordinates(mesh.topology, surfaces, mesh.positions, {2, 1});
  ASSERT_TRUE(found);
  const Eigen::Index each = mesh.positions.rows() / 3;
  for (Eigen::Index i = 0; i < 2 * each; ++i) {
    EXPECT_NEAR(found->row(i).norm(), 1, 0.01) << "on a ball";
    EXPECT_NEAR((*found)(i, 2), mesh.positions(i, 2) / (i < each ? 2 : 3), 0.01);
  }
  EXPECT_EQ((*found)(2 * each, 2), kNoEyeballCoordinate);
  surfaces.polygon_colours.assign(surfaces.kinds.size(), Eigen::Array3f(1, 1, 1));
  EXPECT_FALSE(eye_coordinates(mesh.topology, surfaces, mesh.positions, {2, 1}))
      << "paints come first";
  EXPECT_FALSE(eye_coordinates(mesh.topology, {}, mesh.positions, {2, 1}));
}

}  // namespace
}  // namespace crowdface
