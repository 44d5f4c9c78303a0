// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/render/ray_scene.h"

namespace crowdface {

/// An image is cut into squares of this side, in pixels; the rim around each belongs to others, too.
inline constexpr int kSquareBits = 6;
inline constexpr int kSquare = 1 << kSquareBits;
inline constexpr int kRim = 2;
/// A square with its rim.
inline constexpr int kRimmed = kSquare + 2 * kRim;

/// Lists of numbers end with as many more as a vector of the processor holds at most.
inline constexpr std::size_t kMostLanes = 16;

/// A vertex on the image.
struct alignas(16) PlacedVertex {
  float x, y;      ///< in pixels; infinite behind the camera
  float nearness;  ///< reciprocal of the distance in lengths of the ray through it
};

/// The pixels that a quad may lie on, counted from the corner of a square's rim; both ends are among them.
struct QuadOnPixels {
  std::uint32_t quad;
  std::uint8_t left, top, right, bottom;
};

/// Two lists for each square of an image, by rows: quads that may be seen in the middle of a pixel, and those that may
/// be only elsewhere.
using SquareLists = std::vector<std::array<std::vector<QuadOnPixels>, 2>>;

/// Adds quads to all squares in which, or in whose rims, they may be seen.
/// \param first, end  rows of `quads`
/// \param a_row       squares
void add_to_squares(std::span<const Quad> quads, std::size_t first, std::size_t end,
                    std::span<const PlacedVertex> placed, int a_row, SquareLists& squares);

/// Where in a pixel the camera looks.
class PixelPlaces {
 public:
  /// \param list  each in [0, 1)²
  explicit PixelPlaces(std::vector<Eigen::Vector2f> list);

  const std::vector<Eigen::Vector2f>& list() const { return list_; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(list_.size()); }
  /// x of all, and as many that are no numbers as a vector holds; the same of y.
  const float* x() const { return x_.data(); }
  const float* y() const { return y_.data(); }

 private:
  std::vector<Eigen::Vector2f> list_;
  std::vector<float> x_, y_;
};

/// Where the camera looks in a pixel, and the first of its places among all.
struct LookedPixel {
  const PixelPlaces* places = nullptr;  ///< or nowhere
  std::uint32_t first = 0;
};

/// What is in front at places of pixels; each list ends with as many more as a vector holds.
struct FrontQuads {
  static constexpr std::uint32_t kNothing = 0xffffffffU;
  std::vector<float> nearness;       ///< 0: nothing is there
  std::vector<std::uint32_t> front;  ///< 2 · quad, and 1 more for the second of its triangles

  explicit FrontQuads(std::size_t places);
};

/// Corners of a quad's two triangles, as Embree cuts it.
inline constexpr std::array<std::array<std::size_t, 3>, 2> kQuadHalves = {{{0, 1, 3}, {2, 3, 1}}};

/// Puts quads in front where they are nearer than what is there; of two that are equally near the first stays. The
/// same bits with any instruction set.
/// \param corner  pixel of the image at the corner of the square's rim
/// \param pixels  of the square with its rim, by rows
void put_in_front(std::span<const QuadOnPixels> some, std::span<const Quad> quads,
                  std::span<const PlacedVertex> placed, std::array<int, 2> corner,
                  std::span<const LookedPixel> pixels, FrontQuads& fronts);

}  // namespace crowdface
