// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/render/front_quads.h"
#include "crowdface/render/ray_scene.h"

namespace crowdface {

/// Pixels of an image; `right` and `bottom` are the first outside.
struct PixelRectangle {
  int left, top, right, bottom;

  int width() const { return right - left; }
  std::size_t count() const { return index(left, bottom); }
  /// Of a pixel among them, by rows.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>((y - top) * width() + x - left);
  }
};

/// Quads as a camera sees them that stands at (0, 0, distance) and looks along −z at [−1, 1]² of the plane z = 0. They
/// are found on the image once; then squares of it are asked for, by any thread. What RayScene finds with a tree of
/// quads is found here without, quicker than a tree is fitted where quads are smaller than pixels.
class ScreenQuads {
 public:
  /// Forgets all others. Quads that reach behind the camera are not seen.
  /// \param points  x, y, z of each vertex; must outlive the use of this object, as `quads` must.
  /// \param size    of the square image, in pixels
  void put(const std::vector<float>& points, const std::vector<Quad>& quads, float distance,
           int size);

  /// What the camera meets first at places of some pixels; distances in lengths of rays to the plane z = 0.
  /// \param square  column and row
  /// \param pixels  of the square and its rim
  /// \param places  of each of these pixels, or null: nobody looks there
  /// \param hits    gets one for each place, pixel by pixel.
  void nearest_hits(std::array<int, 2> square, const PixelRectangle& pixels,
                    std::span<const PixelPlaces* const> places,
                    std::vector<std::optional<RayHit>>& hits) const;

 private:
  RayHit hit(std::uint32_t front, const Eigen::Array2f& at) const;

  const float* points_ = nullptr;
  std::span<const Quad> quads_;
  int a_row_ = 0;                     ///< squares
  std::vector<PlacedVertex> placed_;  ///< #V
  std::vector<SquareLists> blocks_;   ///< of quads that follow each other
};

}  // namespace crowdface
