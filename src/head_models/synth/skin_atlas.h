// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "crowdface/core/parallel.h"
#include "head_models/synth/mean_head.h"

namespace crowdface::synth {

/// The point of the average head that one texel of the skin texture shows.
struct AtlasTexel {
  SkinPoint skin;  ///< the point on the average head
  /// Coordinate LatticePoint::b in the rings around an eye: 0 at their outline, 1 at the edge of
  /// the lid, 2 at the hole
  double eye_ring_coordinate = 0;
  /// Coordinate LatticePoint::b in the rings around the mouth: 1 at the edge of the opening between
  /// the lips
  double mouth_ring_coordinate = 0;
  /// Coordinate LatticePoint::b in the rings around a nostril: 1 at the edge of the nostril
  double nostril_ring_coordinate = 0;
  double on_eyeball = 0;  ///< 1 on an eyeball, 0 elsewhere
  Eigen::Vector3d point_on_ball =
      Eigen::Vector3d::Zero();  ///< on an eyeball: point on the unit sphere with its pupil at +z
};

/// The points of the average head that the texels of a square skin texture show. Texels are
/// numbered row by row; the first row lies at v = 1.
class SkinAtlas {
 public:
  /// \param side  width and height of the texture in texels, 64 … 8192.
  explicit SkinAtlas(int side);

  std::size_t side() const { return side_; }
  std::size_t size() const { return texels_.size(); }
  /// Whether the texel shows a surface.
  bool is_covered(std::size_t texel) const { return texels_[texel] < kFirstCopy; }
  /// The texel itself if it is covered, else a nearby covered texel. Uncovered texels are copies of
  /// their source, so that colours continue beyond the edges of the texture charts.
  std::size_t source_texel(std::size_t texel) const {
    return is_covered(texel) ? texel : texels_[texel] - kFirstCopy;
  }
  /// Returns the point of the average head that a texel shows, interpolated in a triangle. For an
  /// uncovered texel, returns the point that its source_texel shows.
  AtlasTexel operator[](std::size_t texel) const;

 private:
  /// Values of `texels_` from kFirstCopy on belong to uncovered texels, smaller values to covered
  /// texels.
  static constexpr std::uint32_t kFirstCopy = 0x80000000U;
  struct Triangle {
    std::array<Eigen::Vector2d, 3> corners;  ///< in texels
    std::array<std::uint32_t, 3> points;     ///< indices of the corners in points_
  };
  Eigen::Vector3d barycentric(const Triangle& triangle, std::size_t texel) const;
  void rasterise(std::uint32_t triangle);
  void find_sources_of_uncovered_texels();

  std::size_t side_;
  std::vector<AtlasTexel> points_;  ///< the points of the skin at the corners of `triangles_`
  std::vector<Triangle> triangles_;
  /// For a covered texel: index of its triangle; for another texel: kFirstCopy + source_texel.
  std::vector<std::uint32_t> texels_;
};

/// Calls `body(left, top, right, bottom)` in parallel for squares of texels that together cover a
/// side × side texture; `right` and `bottom` are one past the last column and row. Squares are used
/// instead of rows, because SmoothNoise is fast for points that are close together.
template <class Body>
void for_each_square(std::size_t side, const Body& body) {
  constexpr std::size_t kSquare = 64;
  const std::size_t squares = (side + kSquare - 1) / kSquare;
  parallel_for_each(squares * squares, [&](std::size_t square) {
    const std::size_t left = square % squares * kSquare, top = square / squares * kSquare;
    body(left, top, std::min(left + kSquare, side), std::min(top + kSquare, side));
  });
}
/// Calls `body(i)` for all texels i of a side × side texture in parallel.
template <class Body>
void for_each_texel(std::size_t side, const Body& body) {
  for_each_square(side,
                  [&](std::size_t left, std::size_t top, std::size_t right, std::size_t bottom) {
                    for (std::size_t y = top; y < bottom; ++y) {
                      for (std::size_t x = left; x < right; ++x) body(y * side + x);
                    }
                  });
}

}  // namespace crowdface::synth
