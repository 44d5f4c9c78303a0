// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/face_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/render/shading.h"

#include "render/project.h"
#include "render/shapes.h"

namespace crowdface {
namespace {

Camera camera_for(const Positions& positions) {
  const Positions* heads[] = {&positions};
  return fit_camera(heads, {}, View::kFront);
}

/// The backdrop's own colour in the middle of a row.
std::array<std::uint8_t, 3> backdrop(int y, int size) {
  return to_srgb8(background_colour((static_cast<float>(y) + 0.5F) / static_cast<float>(size)));
}

bool is_backdrop(const Rgb8Image& image, int x, int y) {
  const auto expected = backdrop(y, image.height);
  for (std::size_t c = 0; c < 3; ++c) {
    if (std::abs(image.at(x, y)[c] - expected[c]) > 1) return false;
  }
  return true;
}

int largest_difference(const Rgb8Image& a, const Rgb8Image& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    largest = std::max(largest, std::abs(a.pixels[i] - b.pixels[i]));
  }
  return largest;
}

TEST(FaceRenderer, SphereIsADiscOfTheRightSize) {
  const Mesh sphere = make_sphere(3, 60, 120);
  const Camera camera = camera_for(sphere.positions);
  const int size = 200;
  const FaceRenderer renderer(sphere.topology, {.size_px = size});
  const Rgb8Image image = renderer.render(sphere.positions, camera);
  // Seen from distance d, the outline of a sphere of radius r lies at the tangent r / √(d² − r²).
  const double d = camera.distance;
  const double radius = size / 2.0 * (3 / std::sqrt(d * d - 9)) / camera.tan_half_fov;
  EXPECT_NEAR(radius, size * 0.44, 0.5);  // the default margin is 0.06
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double r = std::hypot(x + 0.5 - size / 2.0, y + 0.5 - size / 2.0);
      if (std::abs(r - radius) < 1.5) continue;  // the antialiased rim
      EXPECT_EQ(is_backdrop(image, x, y), r > radius) << x << " " << y;
    }
  }
}

TEST(FaceRenderer, KeyLightComesFromTheUpperLeft) {
  const Mesh sphere = make_sphere(1);
  const FaceRenderer renderer(sphere.topology, {.size_px = 100});
  const Rgb8Image image = renderer.render(sphere.positions, camera_for(sphere.positions));
  EXPECT_GT(image.at(35, 35)[1], image.at(60, 65)[1] + 30);
}

TEST(FaceRenderer, SamePixelsEachTimeAndOnAnyNumberOfThreads) {
  const Mesh sphere = make_sphere(1, 150, 300);
  const Camera camera = camera_for(sphere.positions);
  const FaceRenderer renderer(sphere.topology, {.size_px = 96});
  const Rgb8Image first = renderer.render(sphere.positions, camera);
  EXPECT_EQ(renderer.render(sphere.positions, camera), first);
  EXPECT_EQ(FaceRenderer(sphere.topology, {.size_px = 96}).render(sphere.positions, camera), first);
  const ThreadLimit one(1);
  EXPECT_EQ(renderer.render(sphere.positions, camera), first);
}

TEST(FaceRenderer, FittingTheTreeToAFaceChangesNoPixel) {
  const Mesh sphere = make_sphere(1, 60, 120);
  const Camera camera = camera_for(2 * sphere.positions);
  Positions egg = sphere.positions, dented = sphere.positions;
  egg.col(1) *= 1.7;
  for (Index i = 0; i < dented.rows(); ++i) dented.row(i) *= 1 + 0.3 * std::sin(7 * dented(i, 0));
  const Positions far = egg.rowwise() + Eigen::RowVector3d(0.5, 0.25, -3);
  const RenderOptions options = {.size_px = 96};
  const FaceRenderer anew(sphere.topology, options);
  const FaceRenderer fitted(sphere.topology, options, {}, &sphere.positions);
  // There and back again: a face's picture does not depend on the faces before it.
  const Positions* const faces[] = {&egg, &far, &dented, &sphere.positions, &egg};
  for (const Positions* face : faces) {
    EXPECT_EQ(fitted.render(*face, camera), anew.render(*face, camera));
  }
  const auto several = [&](const FaceRenderer& renderer) {
    std::vector<Rgb8Image> images(12, Rgb8Image(1, 1));
    parallel_for_each(12, [&](Index i) {
      images[static_cast<std::size_t>(i)] = renderer.render(i % 2 == 0 ? egg : dented, camera);
    });
    return images;
  };
  EXPECT_EQ(several(fitted), several(anew)) << "from several threads at once";
}

// Of a mesh as fine as this light is kept out by a reduced one.
TEST(FaceRenderer, OfAFineMeshAFittedFaceLooksAsWhenItIsDrawnAnew) {
  const Mesh balls =
      join_meshes(make_sphere(1, 240, 480), make_sphere(0.5, 60, 120), {0.9, 0.5, 0.9});
  ASSERT_GT(balls.topology.face_count(), 100'000);
  Positions face = balls.positions;
  face.col(1) *= 1.3;
  const Camera camera = camera_for(1.3 * balls.positions);
  const RenderOptions options = {.size_px = 128};
  const Rgb8Image anew = FaceRenderer(balls.topology, options).render(face, camera);
  const Rgb8Image fitted =
      FaceRenderer(balls.topology, options, {}, &balls.positions).render(face, camera);
  double sum = 0;
  for (std::size_t i = 0; i < anew.pixels.size(); ++i) {
    sum += std::abs(anew.pixels[i] - fitted.pixels[i]);
  }
  EXPECT_LT(sum / static_cast<double>(anew.pixels.size()), 0.1) << "of 255";
  EXPECT_LE(largest_difference(anew, fitted), 40) << "a shadow's edge moves by little";
}

TEST(FaceRenderer, OneFlatShapeLooksTheSameInTrianglesQuadsAndOnePolygon) {
  Positions square(6, 3);
  square << -1, -1, 0, 0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0;
  const Topology polygon = {6, {0, 1, 2, 3, 4, 5}, {}, {0, 6}};
  const Topology quads = {6, {0, 1, 4, 5, 1, 2, 3, 4}, {}, {0, 4, 8}};
  const Topology triangles = {6, {0, 1, 4, 0, 4, 5, 1, 2, 3, 1, 3, 4}, {}, {0, 3, 6, 9, 12}};
  const Camera camera = camera_for(square);
  const RenderOptions options = {.size_px = 64};
  const Rgb8Image expected = FaceRenderer(quads, options).render(square, camera);
  EXPECT_LE(largest_difference(FaceRenderer(polygon, options).render(square, camera), expected), 1);
  EXPECT_LE(largest_difference(FaceRenderer(triangles, options).render(square, camera), expected),
            1);
  EXPECT_FALSE(is_backdrop(expected, 32, 32));
}

TEST(FaceRenderer, TheUnitDoesNotMatter) {
  const Mesh one = make_sphere(1);
  const Mesh large = make_sphere(256);
  const RenderOptions options = {.size_px = 64};
  EXPECT_LE(
      largest_difference(
          FaceRenderer(one.topology, options).render(one.positions, camera_for(one.positions)),
          FaceRenderer(large.topology, options)
              .render(large.positions, camera_for(large.positions))),
      2);
}

TEST(FaceRenderer, AMirroredMeshIsTurnedAndLooksAlike) {
  const Mesh sphere = make_sphere(1);
  Positions mirrored = sphere.positions;
  mirrored.col(0) *= -1;  // the same shape, wound inside out
  const Camera camera = camera_for(sphere.positions);
  const FaceRenderer renderer(sphere.topology, {.size_px = 64});
  EXPECT_LE(largest_difference(renderer.render(mirrored, camera),
                               renderer.render(sphere.positions, camera)),
            12);
}

TEST(FaceRenderer, TheInsideOfASurfaceIsDarker) {
  const Mesh sphere = make_sphere(1);
  Topology bowl = sphere.topology;  // without the front: one looks into the back half
  bowl.corner_vertices.clear();
  bowl.face_offsets = {0};
  for (Index f = 0; f < sphere.topology.face_count(); ++f) {
    const auto face = sphere.topology.face(f);
    if (sphere.positions(face[0], 2) > 0.3) continue;
    bowl.corner_vertices.insert(bowl.corner_vertices.end(), face.begin(), face.end());
    bowl.face_offsets.push_back(static_cast<std::uint32_t>(bowl.corner_vertices.size()));
  }
  const Camera camera = camera_for(sphere.positions);
  const RenderOptions options = {.size_px = 64};
  const Rgb8Image outside = FaceRenderer(sphere.topology, options).render(sphere.positions, camera);
  const Rgb8Image inside = FaceRenderer(bowl, options).render(sphere.positions, camera);
  EXPECT_LT(inside.at(32, 32)[0], outside.at(32, 32)[0] / 2);
}

TEST(FaceRenderer, OcclusionDarkensACrevice) {
  const Mesh balls = join_meshes(make_sphere(1), make_sphere(1), {2, 0, 0});  // touching at x = 1
  const Camera camera = camera_for(balls.positions);
  const Rgb8Image open = FaceRenderer(balls.topology, {.size_px = 64, .ambient_occlusion = false})
                             .render(balls.positions, camera);
  const Rgb8Image closed =
      FaceRenderer(balls.topology, {.size_px = 64}).render(balls.positions, camera);
  const auto drop = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector2d place = 64 * testing::project(camera, point);
    const int x = static_cast<int>(place.x());
    const int y = static_cast<int>(place.y());
    return open.at(x, y)[0] - closed.at(x, y)[0];
  };
  EXPECT_GT(drop({0.92, 0, 0.39}), 15);
  EXPECT_LE(drop({-0.3, 0, 0.95}), 1);
}

TEST(FaceRenderer, SoftShadowsHaveNoGrain) {
  // A ball before a wall; the wall as a dense disc of a sphere so large that it is all but flat.
  const Mesh scene = join_meshes(make_sphere(20, 200, 400), make_sphere(0.5), {-0.1, 0.1, 20.8});
  Camera camera = camera_for(scene.positions.bottomRows(make_sphere(0.5).positions.rows()));
  camera.distance *= 2.5;
  const int size = 128;
  const Rgb8Image image =
      FaceRenderer(scene.topology, {.size_px = size}).render(scene.positions, camera);
  const Rgb8Image smooth =
      FaceRenderer(scene.topology,
                   {.size_px = size, .samples_per_side = 12, .key_light_rays = 48, .sky_rays = 48})
          .render(scene.positions, camera);
  double squares = 0;
  int shadow = 255;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double difference = image.at(x, y)[1] - smooth.at(x, y)[1];
      squares += difference * difference;
      shadow = std::min<int>(shadow, smooth.at(x, y)[1]);
    }
  }
  EXPECT_LT(shadow, 130) << "there is a shadow";
  EXPECT_LT(std::sqrt(squares) / size, 1.3) << "of 255, against sixteen times as many rays";
}

TEST(FaceRenderer, HiddenFacesAreNotThere) {
  const Mesh sphere = make_sphere(1);
  const std::vector<SurfaceKind> kinds(static_cast<std::size_t>(sphere.topology.face_count()),
                                       SurfaceKind::kHidden);
  const Rgb8Image image = FaceRenderer(sphere.topology, {.size_px = 32}, {kinds})
                              .render(sphere.positions, camera_for(sphere.positions));
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) EXPECT_TRUE(is_backdrop(image, x, y));
  }
}

TEST(FaceRenderer, AnEyeballLooksWithADarkPupil) {
  const Mesh ball = make_sphere(1);
  const std::vector<SurfaceKind> kinds(static_cast<std::size_t>(ball.topology.face_count()),
                                       SurfaceKind::kEye);
  const Camera camera = camera_for(ball.positions);
  const Rgb8Image ahead =
      FaceRenderer(ball.topology, {.size_px = 64}, {kinds}).render(ball.positions, camera);
  EXPECT_LT(ahead.at(33, 33)[0], 90);
  EXPECT_GT(ahead.at(12, 33)[0], 110);
  // Eyes that look away show no pupil.
  const Rgb8Image away = FaceRenderer(ball.topology, {.size_px = 64, .front = {2, -1}}, {kinds})
                             .render(ball.positions, camera);
  EXPECT_GT(away.at(33, 33)[0], 110);
}

TEST(FaceRenderer, VertexColoursReplaceTheSurface) {
  const Mesh sphere = make_sphere(1);
  VertexColours colours = VertexColours::Zero(sphere.positions.rows(), 3);
  for (Index i = 0; i < colours.rows(); ++i) {
    colours(i, sphere.positions(i, 0) < 0 ? 0 : 2) = 0.8F;  // left red, right blue
  }
  const Rgb8Image image = FaceRenderer(sphere.topology, {.size_px = 64})
                              .render(sphere.positions, camera_for(sphere.positions), &colours);
  EXPECT_GT(image.at(20, 32)[0], image.at(20, 32)[2] + 60);
  EXPECT_GT(image.at(44, 32)[2], image.at(44, 32)[0] + 30);
}

TEST(FaceRenderer, FacesWithoutAreaDoNoHarm) {
  Mesh sphere = make_sphere(1);
  auto& topology = sphere.topology;
  for (const std::uint32_t vertex : {5U, 5U, 5U, 6U, 6U, 7U, 9U, 10U}) {
    topology.corner_vertices.push_back(vertex);
  }
  const auto end = static_cast<std::uint32_t>(topology.corner_vertices.size());
  topology.face_offsets.insert(topology.face_offsets.end(), {end - 5, end - 2, end});
  const Camera camera = camera_for(sphere.positions);
  const Mesh plain = make_sphere(1);
  EXPECT_LE(largest_difference(
                FaceRenderer(topology, {.size_px = 64}).render(sphere.positions, camera),
                FaceRenderer(plain.topology, {.size_px = 64}).render(plain.positions, camera)),
            40);
}

TEST(FaceRenderer, RefusesWhatDoesNotFit) {
  const Mesh sphere = make_sphere(1);
  const Camera camera = camera_for(sphere.positions);
  EXPECT_THROW(FaceRenderer(sphere.topology, {.size_px = 0}), BrokenPrecondition);
  EXPECT_THROW(FaceRenderer(sphere.topology, {.samples_per_side = 0}), BrokenPrecondition);
  EXPECT_THROW(FaceRenderer(sphere.topology, {.key_light_rays = 0}), BrokenPrecondition);
  EXPECT_THROW(FaceRenderer(sphere.topology, {.sky_rays = 0}), BrokenPrecondition);
  EXPECT_THROW(FaceRenderer(sphere.topology, {}, {{SurfaceKind::kSkin}}), BrokenPrecondition);
  const FaceRenderer renderer(sphere.topology, {.size_px = 16});
  EXPECT_THROW(renderer.render(sphere.positions.topRows(5), camera), BrokenPrecondition);
  const Positions five = sphere.positions.topRows(5);
  EXPECT_THROW(FaceRenderer(sphere.topology, {}, {}, &five), BrokenPrecondition);
  const VertexColours few = VertexColours::Zero(5, 3);
  EXPECT_THROW(renderer.render(sphere.positions, camera, &few), BrokenPrecondition);
  Positions broken = sphere.positions;
  broken(7, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THROW(renderer.render(broken, camera), InvalidInput);
}

}  // namespace
}  // namespace crowdface
