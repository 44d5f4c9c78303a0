// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "crowdface/render/shading.h"

namespace crowdface {

/// Points that are shaded side by side, as `shade` says. The same bits with any instruction set and in any company.
class ShadeBatch {
 public:
  void clear() { count_ = 0; }
  void add(const ShadePoint& point, float gleam);
  void shade();

  /// Light of point `i` in the order of adding, after `shade`.
  Light light(std::size_t i) const {
    const float* at = lights_.data() + i / kBlock * 3 * kBlock + i % kBlock;
    return {at[0], at[kBlock], at[2 * kBlock]};
  }

  /// Numbers of a point; those of kBlock points stand together, field by field.
  enum Field {
    kNormal,
    kToEye = kNormal + 3,
    kAlbedo = kToEye + 3,
    kWrap = kAlbedo + 3,
    kRoughness = kWrap + 3,
    kReflectance,
    kKey,
    kSky,
    kGleam,
    kShown,  ///< of the light
    kFields
  };
  static constexpr std::size_t kBlock = 16;

 private:
  std::size_t count_ = 0;
  std::vector<float> points_;  ///< blocks, fields, points
  std::vector<float> lights_;  ///< blocks, red green blue, points
};

}  // namespace crowdface
