// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "crowdface/render/front_quads.h"

namespace crowdface {

/// What is known of points of the surface, a list of each number: where they lie, how much of the key light and the
/// sky arrives as found by rays.
struct PointLights {
  enum Field {
    kPoint,
    kNormal = kPoint + 3,
    kKeyOpen = kNormal + 3,  ///< rays that reached it
    kKeyAsked,               ///< of so many
    kSkyOpen,
    kSkyAsked,
    kFields
  };
  std::array<const float*, kFields> lists;
};

/// The same of a square's pixels and a rim of one around them: means of what a pixel shows, so that normals are shorter
/// than 1 where they differ, and sums of its rays.
class PixelLights {
 public:
  static constexpr std::size_t kStride =
      kSquare + 2 + 14;  ///< a row ends with as many as a vector holds

  PixelLights() { clear(); }
  /// All pixels empty, which nothing shares with: their normals are 0.
  void clear();
  /// \param x, y  from −1 to kSquare, counted from the square's corner
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y + 1) * kStride + static_cast<std::size_t>(x + 1);
  }
  float* list(int field) { return numbers_.data() + static_cast<std::size_t>(field) * kSize; }
  const float* list(int field) const {
    return numbers_.data() + static_cast<std::size_t>(field) * kSize;
  }

 private:
  static constexpr std::size_t kSize = (kSquare + 2) * kStride + 16;
  std::vector<float> numbers_;
};

/// How much of the lights arrives at points, in shares: of the rays that they themselves and the pixels around theirs
/// have sent, each weighted by how far the pixel shows the point's surface. The same bits with any instruction set.
/// \param points     lists that end with as many more as a vector holds, whatever they are
/// \param pixel      that shows the points, or the first of them if each is in the pixel after that of the one before
/// \param in_a_row   which of the two
/// \param key, sky   with room for `count` and as many as a vector holds
void share_lights(const PointLights& points, std::size_t count, const PixelLights& pixels,
                  std::size_t pixel, bool in_a_row, float pixel_side, float* key, float* sky);

}  // namespace crowdface
