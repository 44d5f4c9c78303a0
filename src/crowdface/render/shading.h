// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "crowdface/render/studio.h"

namespace crowdface {

/// A point of the surface in the camera's own axes: x right, y up, z towards the camera.
struct ShadePoint {
  Eigen::Vector3f normal;  ///< unit, on the side that is seen
  Eigen::Vector3f to_eye;  ///< unit
  Light albedo;
  SurfaceKind kind = SurfaceKind::kSkin;
  bool inside = false;   ///< the back of the surface is seen: nostrils, sockets
  float sky = 1;         ///< share of the ambient light that arrives
  float key = 1;         ///< share of the key light that arrives
  float roughness = -1;  ///< of its gloss, 0 … 1; below 0: what its kind has
};

/// Light that comes from a point in the studio. Skin scatters light past the shadow's edge, red
/// furthest (wrapped diffuse); the highlights are microfacet (Walter et al. 2007).
/// \param gleam  what part of its gloss the surface has.
Light shade(const ShadePoint& point, float gleam = 1);

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
