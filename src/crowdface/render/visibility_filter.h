// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "crowdface/render/front_quads.h"

namespace crowdface {

/// Surface points with the results of their shadow rays: position, normal, and for each light the
/// number of rays that reached the light and the number of traced rays. Each field is a separate
/// array.
struct PointVisibility {
  /// Index into `field_values`. The three coordinates of a vector are three consecutive fields.
  enum Field {
    kPoint,
    kNormal = kPoint + 3,
    kKeyVisible = kNormal + 3,  ///< number of the point's rays that reached the key light
    kKeyTraced,                 ///< number of the point's rays towards the key light
    kSkyVisible,                ///< number of the point's rays that reached the sky
    kSkyTraced,                 ///< number of the point's rays towards the sky
    kFields
  };
  std::array<const float*, kFields> field_values;  ///< one array per field, #points numbers each
};

/// The visibility of the lights at each pixel of a square of the image and of a rim of one pixel
/// around the square. Combines the fields of PointVisibility over the points of a pixel: means of
/// positions and normals (a mean normal is shorter than 1 if the normals differ), and sums of the
/// numbers of rays.
class PixelVisibility {
 public:
  /// Length of a row: the square, a rim of 1 pixel at both ends, and 14 numbers as padding to a
  /// multiple of 16.
  static constexpr std::size_t kStride = kSquareSide + 2 + 14;

  PixelVisibility() { clear(); }
  /// Marks all pixels as empty: sets their normals to 0, so that filter_visibility ignores the
  /// pixels.
  void clear();
  /// Index of a pixel's value in field_values().
  /// \param x, y  from −1 to kSquareSide, relative to the square's corner
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y + 1) * kStride + static_cast<std::size_t>(x + 1);
  }
  /// Returns the values of a PointVisibility field; index() gives the position of a pixel's value.
  float* field_values(int field) {
    return field_values_.data() + static_cast<std::size_t>(field) * kSize;
  }
  const float* field_values(int field) const {
    return field_values_.data() + static_cast<std::size_t>(field) * kSize;
  }

 private:
  /// number of values of each field: one per pixel, then 16 numbers as padding for SIMD loads
  static constexpr std::size_t kSize = (kSquareSide + 2) * kStride + 16;
  /// the values of all PointVisibility fields: kSize values for each field, one field after another
  std::vector<float> field_values_;
};

/// Estimates, for each point, the visible fraction of the key light and of the sky, by a bilateral
/// filter. The visible fraction of a light is the number of rays that reached the light, divided by
/// the number of traced rays. Both numbers are weighted sums over the 3 by 3 pixels around the
/// point. The weight of a pixel tells how well its normal and position match the point's surface.
/// The result has the same bits with every instruction set.
/// \param points  arrays padded by kMaxLanes entries of any value
/// \param pixel      if `consecutive`: index of the first point's pixel. Otherwise: index of the
///                   pixel that contains all points.
/// \param consecutive  true: the points lie in consecutive pixels of a row, one point per pixel;
///                   false: all points lie in one pixel
/// \param pixel_side  side of a pixel in the unit of the positions
/// \param key, sky   results: visible fractions, with room for `count` + kMaxLanes numbers
void filter_visibility(const PointVisibility& points, std::size_t count,
                       const PixelVisibility& pixels, std::size_t pixel, bool consecutive,
                       float pixel_side, float* key, float* sky);

}  // namespace crowdface
