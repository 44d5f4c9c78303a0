// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/screen_quads.h"

#include <algorithm>
#include <random>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "crowdface/core/instruction_set.h"
#include "crowdface/core/parallel.h"
#include "crowdface/render/sampling_pattern.h"

#include "render/shapes.h"

namespace crowdface {
namespace {

constexpr float kDistance = 5;

/// What is seen at some places of every pixel of an image, by squares, and the rays that look there.
struct Look {
  std::vector<Ray> rays;
  std::vector<std::optional<RayHit>> hits;
};

Look look(const std::vector<float>& points, const std::vector<Quad>& quads, int size,
          const PixelSamples& places) {
  ScreenQuads screen;
  screen.project(points, quads, kDistance, size);
  Look look;
  for (int top = 0; top < size; top += kSquareSide) {
    for (int left = 0; left < size; left += kSquareSide) {
      const PixelRectangle pixels = {std::max(left - kRimWidth, 0), std::max(top - kRimWidth, 0),
                                     std::min(left + kSquareSide + kRimWidth, size),
                                     std::min(top + kSquareSide + kRimWidth, size)};
      std::vector<std::optional<RayHit>> hits;
      const std::vector<const PixelSamples*> all(pixels.count(), &places);
      screen.nearest_hits({left / kSquareSide, top / kSquareSide}, pixels, all, hits);
      look.hits.insert(look.hits.end(), hits.begin(), hits.end());
      for (int y = pixels.top; y < pixels.bottom; ++y) {
        for (int x = pixels.left; x < pixels.right; ++x) {
          for (const Eigen::Vector2f& place : places.positions()) {
            const float to_x = 2 * (static_cast<float>(x) + place.x()) / static_cast<float>(size);
            const float to_y = 2 * (static_cast<float>(y) + place.y()) / static_cast<float>(size);
            look.rays.push_back({{0, 0, kDistance}, {to_x - 1, 1 - to_y, -kDistance}});
          }
        }
      }
    }
  }
  return look;
}

/// Quads of any shape and size, some of them triangles or behind the camera, from a hundredth of the image's side.
struct Soup {
  std::vector<float> points;
  std::vector<Quad> quads;

  Soup(int count, unsigned int seed) {
    std::mt19937 random(seed);
    const auto number = [&](float most) {
      return most * (static_cast<float>(random() % 20001) / 10000 - 1);
    };
    for (int q = 0; q < count; ++q) {
      const float side = q % 10 == 0 ? 0.7F : 0.04F;
      const float middle[] = {number(1.3F), number(1.3F), q % 50 == 7 ? kDistance : number(2)};
      const auto first = static_cast<std::uint32_t>(points.size() / 3);
      for (int c = 0; c < 4; ++c) {
        for (const float at : middle) points.push_back(at + number(side));
      }
      quads.push_back({first, first + 1, first + 2, q % 3 == 0 ? first + 2 : first + 3});
    }
  }
};

// The ray tracer is another program that answers the same question.
TEST(ScreenQuads, MeetWhatRaysMeet) {
  for (const unsigned int seed : {1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    const Soup soup(3000, seed);
    const RayDevice device;
    const RayScene scene(device, soup.points, soup.quads);
    for (const int side : {1, 2, 3, 5}) {
      SCOPED_TRACE(side);
      const Look look = crowdface::look(soup.points, soup.quads, 71,
                                        PixelSamples(sample_positions_in_pixel(side)));
      const auto expected = scene.nearest_hits(look.rays);
      ASSERT_EQ(look.hits.size(), expected.size());
      std::size_t met = 0, others = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        // Quads that reach behind the camera are not seen here.
        if (expected[i] && expected[i]->primitive % 50 == 7) continue;
        met += expected[i] ? 1 : 0;
        if (expected[i].has_value() != look.hits[i].has_value() ||
            (expected[i] && expected[i]->primitive != look.hits[i]->primitive)) {
          ++others;  // right at an edge
          continue;
        }
        if (!expected[i]) continue;
        const RayHit &a = *expected[i], &b = *look.hits[i];
        EXPECT_NEAR(a.distance, b.distance, 2e-5);
        EXPECT_NEAR(a.u, b.u, 2e-2) << i;
        EXPECT_NEAR(a.v, b.v, 2e-2) << i;
        EXPECT_GT(a.normal.normalized().dot(b.normal.normalized()), 0.999F);
      }
      EXPECT_GT(met, expected.size() / 2);
      EXPECT_LE(others, expected.size() / 1000);
    }
  }
}

/// Triangles and quads on a grid that covers the image and stands askew to it, shuffled.
Soup grid(int cells) {
  Soup grid(0, 0);
  const auto row = static_cast<std::uint32_t>(cells) + 1;
  for (std::uint32_t v = 0; v < row * row; ++v) {
    const float x = 3 * (static_cast<float>(v % row) / static_cast<float>(cells) - 0.5F);
    const float y = 3 * (static_cast<float>(v / row) / static_cast<float>(cells) - 0.5F);
    for (const float at : {x + 0.2F * y, y - 0.1F * x, 0.1F * x * y}) grid.points.push_back(at);
  }
  for (std::uint32_t y = 0; y + 1 < row; ++y) {
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = y * row + x, b = a + 1, c = b + row, d = a + row;
      if ((x + y) % 2 == 0) {
        grid.quads.push_back({a, b, c, d});
      } else {
        grid.quads.push_back({a, b, c, c});
        grid.quads.push_back({c, d, a, a});
      }
    }
  }
  std::shuffle(grid.quads.begin(), grid.quads.end(), std::mt19937(1));
  return grid;
}

TEST(ScreenQuads, ASurfaceHasNoHoles) {
  for (const int cells : {4, 60, 400}) {  // from a quarter of the image to a fifth of a pixel
    const Soup surface = grid(cells);
    const Look look = crowdface::look(surface.points, surface.quads, 96,
                                      PixelSamples(sample_positions_in_pixel(3)));
    EXPECT_EQ(std::count(look.hits.begin(), look.hits.end(), std::nullopt), 0) << cells;
  }
}

TEST(ScreenQuads, TheSameAloneAndOnManyThreadsAndBesidesAFaceBefore) {
  const Soup surface = grid(300), before = grid(20);
  const PixelSamples places(sample_positions_in_pixel(2));
  const auto distances = [&](const Look& look) {
    std::vector<float> found;
    for (const auto& hit : look.hits) found.push_back(hit->distance);
    return found;
  };
  const auto many = distances(look(surface.points, surface.quads, 2 * kSquareSide, places));
  const ThreadLimit one(1);
  EXPECT_EQ(distances(look(surface.points, surface.quads, 2 * kSquareSide, places)), many);
  ScreenQuads screen;
  screen.project(before.points, before.quads, kDistance, 4 * kSquareSide);
  screen.project(surface.points, surface.quads, kDistance, 2 * kSquareSide);
  const PixelRectangle pixels = {0, 0, kSquareSide + kRimWidth, kSquareSide + kRimWidth};
  std::vector<std::optional<RayHit>> hits;
  const std::vector<const PixelSamples*> all(pixels.count(), &places);
  screen.nearest_hits({0, 0}, pixels, all, hits);
  EXPECT_TRUE(
      std::equal(hits.begin(), hits.end(), many.begin(),
                 many.begin() + static_cast<std::ptrdiff_t>(hits.size()),
                 [](const auto& hit, float distance) { return hit->distance == distance; }));
}

TEST(ScreenQuads, TheSameWithAnyInstructionSet) {
  const Soup soup(3000, 4);
  const PixelSamples places(sample_positions_in_pixel(3));
  const auto seen = [&] {
    std::vector<std::tuple<std::uint32_t, float, float, float>> found;
    for (const auto& hit : look(soup.points, soup.quads, 71, places).hits) {
      if (hit) found.emplace_back(hit->primitive, hit->u, hit->v, hit->distance);
    }
    return found;
  };
  const auto best = seen();
  EXPECT_GT(best.size(), 10'000U);
  for (const std::string& name : instruction_sets()) {
    use_instruction_set(name);
    EXPECT_EQ(seen(), best) << name;
  }
  use_instruction_set(instruction_sets().front());
}

TEST(ScreenQuads, OnlyPixelsThatAreLookedAtHaveHits) {
  const Soup surface = grid(10);
  ScreenQuads screen;
  screen.project(surface.points, surface.quads, kDistance, 20);
  const PixelSamples few(sample_positions_in_pixel(1)), many(sample_positions_in_pixel(3));
  const PixelRectangle pixels = {2, 3, 6, 5};
  std::vector<const PixelSamples*> places(pixels.count(), nullptr);
  places[pixels.index(3, 3)] = &many;
  places[pixels.index(5, 4)] = &few;
  std::vector<std::optional<RayHit>> hits;
  screen.nearest_hits({0, 0}, pixels, places, hits);
  ASSERT_EQ(hits.size(), 10U);
  EXPECT_EQ(std::count(hits.begin(), hits.end(), std::nullopt), 0);
  screen.project({}, {}, kDistance, 20);
  screen.nearest_hits({0, 0}, pixels, places, hits);
  EXPECT_EQ(std::count(hits.begin(), hits.end(), std::nullopt), 10);
}

}  // namespace
}  // namespace crowdface
