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

/// A rectangle of pixels; `right` and `bottom` are exclusive.
struct PixelRectangle {
  int left, top, right, bottom;

  int width() const { return right - left; }
  /// Number of pixels in the rectangle.
  std::size_t count() const { return index(left, bottom); }
  /// Row-major index of a pixel inside the rectangle.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>((y - top) * width() + x - left);
  }
};

/// A rasterizer for quads, seen by a camera at (0, 0, distance) that looks along −z at the square
/// [−1, 1]² of the plane z = 0. After `project`, any thread may query squares of the image. Finds
/// the same hits as a RayScene of quads. Faster than refitting a tree if quads are smaller than
/// pixels.
class ScreenQuads {
 public:
  /// Replaces and projects the quads. Quads that extend behind the camera are skipped.
  /// \param points    x, y, z of each vertex. `points` and `quads` must outlive the queries.
  /// \param distance  distance of the camera from the plane z = 0, in the unit of `points`
  /// \param size      side of the image, in pixels
  void project(const std::vector<float>& points, const std::vector<Quad>& quads, float distance,
               int size);

  /// Finds the first hit of the camera ray through each sample position of some pixels. The unit of
  /// RayHit::distance is the length of the ray from the camera to the plane z = 0.
  /// \param square  column and row of the square
  /// \param pixels  rectangle of pixels inside the square and its rim
  /// \param samples  for each pixel of the rectangle: the sample positions, or null for no samples
  /// \param hits    result, one for each sample, pixel by pixel
  void nearest_hits(std::array<int, 2> square, const PixelRectangle& pixels,
                    std::span<const PixelSamples* const> samples,
                    std::vector<std::optional<RayHit>>& hits) const;

 private:
  /// Returns the point where the camera ray through a position on the image hits a quad.
  /// \param front_quad      the quad, see DepthBuffer::front_quads
  /// \param pixel_position  the position on the image, in pixels
  RayHit hit(std::uint32_t front_quad, const Eigen::Array2f& pixel_position) const;

  const float* points_ = nullptr;           ///< x, y, z of each vertex
  std::span<const Quad> quads_;             ///< the quads of the last `project`
  int squares_per_row_ = 0;                 ///< number of squares in a row
  std::vector<ProjectedVertex> projected_;  ///< all vertices, projected to the image
  /// for each block of consecutive quads: the quads that overlap each square of the image
  std::vector<SquareLists> square_lists_;
};

}  // namespace crowdface
