// SPDX-License-Identifier: Apache-2.0
// Smoothing and masks on meshes that no scanner makes, against the plain computation.
#include "support/reference.h"

#include <gtest/gtest.h>

#include "crowdface/core/random.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/smooth/chebyshev_filter.h"

#include "support/bowl_heads.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

/// Whole number in [0, count) that depends on the arguments alone.
std::size_t pick(std::size_t count, std::uint64_t seed, std::uint64_t index,
                 std::string_view what) {
  return static_cast<std::size_t>(random_uniform({seed, index, what, 0}) *
                                  static_cast<double>(count));
}

/// Faces of 3 to 6 corners picked at random, corners repeated or not: edges of many faces, isolated
/// vertices, faces that name a vertex twice.
std::string polygon_soup(std::uint64_t seed) {
  std::string text;
  const std::size_t vertices = 8 + pick(20, seed, 0, "vertices");
  for (std::uint64_t v = 0; v < vertices; ++v) {
    text += "v";
    for (std::uint64_t c = 0; c < 3; ++c) {
      text += concat(' ', random_between({seed, 3 * v + c, "place", 0}, -10, 10));
    }
    text += '\n';
  }
  const std::size_t faces = 3 + pick(25, seed, 0, "faces");
  for (std::uint64_t f = 0; f < faces; ++f) {
    text += "f";
    const std::size_t corners = 3 + pick(4, seed, f, "corners");
    for (std::uint64_t c = 0; c < corners; ++c) {
      text += concat(' ', 1 + pick(vertices, seed, 6 * f + c, "corner"));
    }
    text += '\n';
  }
  return text;
}

TEST(Reference, SmoothingAgreesOnPolygonSoup) {
  const testing::TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto path = folder.write("soup.obj", polygon_soup(seed));
    const reference::Obj mesh = reference::read_obj(path);
    const ObjFile file = read_obj(path);
    for (const bool fixed : {true, false}) {
      for (const bool lazy : {true, false}) {
        const SmoothingOperator smoothing(build_adjacency(file.topology),
                                          fixed ? Boundary::kFixed : Boundary::kFree,
                                          lazy ? OperatorKind::kLazy : OperatorKind::kUmbrella);
        const ChebyshevFilter chebyshev(smoothing, file.positions);
        const reference::Filter filter = reference::make_filter(mesh, fixed, lazy);
        for (const std::uint64_t level : {1U, 2U, 17U, 400U}) {
          const Positions found = smooth(chebyshev, file.positions, level);
          const reference::Points expected = reference::smooth(filter, mesh.vertices, level);
          for (std::size_t i = 0; i < expected.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
              ASSERT_NEAR(found(static_cast<Index>(i), static_cast<Index>(c)), expected[i][c], 1e-7)
                  << "seed " << seed << (fixed ? " fixed" : " free") << (lazy ? " lazy" : "")
                  << " level " << level << " vertex " << i + 1;
            }
          }
        }
      }
    }
  }
}

/// Quads of four vertices of their own, each in one tile, with texture coordinates on the tiles'
/// borders, twice the same or (`tiles` 1) outside the picture; some vertices stand in two quads.
std::string scattered_quads(std::uint64_t seed, int tiles) {
  constexpr std::uint64_t kQuads = 30;
  const std::vector<double> places = {0, 0, 1, 1, 0.5, 0.03125, 0.96875};
  std::string text, faces;
  for (std::uint64_t q = 0; q < kQuads; ++q) {
    const auto tile = static_cast<double>(pick(static_cast<std::size_t>(tiles), seed, q, "tile"));
    faces += "f";
    for (std::uint64_t c = 0; c < 4; ++c) {
      const std::uint64_t corner = 4 * q + c;
      text += concat("v ", corner, " 0 0\n");
      // The quad's own middle lies inside the tile: its corners are spread around it.
      const double inside = random_uniform({seed, corner, "u", 0});
      double u = c == 0 ? 0.25 : c == 1 ? 0.75 : inside, v = c == 2 ? 0.375 : inside * inside;
      if (c == 3) {
        u = places[pick(places.size(), seed, q, "place u")];
        v = places[pick(places.size(), seed, q, "place v")];
        if (tiles == 1 && q % 3 == 0) u = 3 * inside - 1, v = 2 - 4 * inside;
      }
      text += concat("vt ", tile + u, ' ', v, '\n');
      const std::uint64_t vertex = c == 0 && q > 0 ? corner - 3 : corner + 1;  // joined to the last
      faces += concat(' ', vertex, '/', corner + 1);
    }
    faces += '\n';
  }
  return text + faces;
}

TEST(Reference, MasksAgreeOnScatteredQuads) {
  const testing::TemporaryFolder folder;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const int tiles = seed % 2 == 0 ? 1 : 3;
    reference::Mask mask;
    for (int tile = 0; tile < tiles; ++tile) {
      const int number = tiles == 1 ? 0 : 1001 + tile;
      mask[number] = testing::mask_picture(1 + seed % 5, 1 + seed % 7, seed * 10 + tile);
      testing::write_mask(folder / (tiles == 1 ? "mask.png" : concat("mask.", number, ".png")),
                          mask[number]);
    }
    const auto path = folder.write("quads.obj", scattered_quads(seed, tiles));
    const auto expected = reference::masks_at_vertices(reference::read_obj(path), {mask}, 3);
    const ObjFile file = read_obj(path);
    const RegionWeights found = region_weights(
        file.topology, file.uvs,
        {MaskSource((folder / (tiles == 1 ? "mask.png" : "mask.<UDIM>.png")).string())}, 3);
    ASSERT_EQ(found.alpha.rows(), static_cast<Index>(expected.size()));
    for (std::size_t i = 0; i < expected.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_NEAR(found.alpha(static_cast<Index>(i), static_cast<Index>(k)), expected[i][k], 1e-6)
            << "seed " << seed << " vertex " << i + 1 << " region " << k;
      }
    }
  }
}

}  // namespace
}  // namespace crowdface
