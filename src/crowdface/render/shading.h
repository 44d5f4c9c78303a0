// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "crowdface/render/studio.h"

namespace crowdface {

/// A surface point to shade, in camera space: x right, y up, z towards the camera.
struct ShadePoint {
  Eigen::Vector3f normal;     ///< unit vector, on the visible side
  Eigen::Vector3f to_viewer;  ///< unit vector towards the viewer
  LinearRgb albedo;           ///< colour of the surface
  SurfaceKind kind = SurfaceKind::kSkin;
  bool is_back = false;      ///< whether the back of the surface is visible, as in nostrils
  float sky_visibility = 1;  ///< visible fraction of the sky
  float key_visibility = 1;  ///< visible fraction of the key light
  float roughness = -1;      ///< 0 … 1; negative: use the roughness of Material
};

/// Radiance that a surface point in the studio reflects towards the camera. Diffuse light reaches
/// past the edge of shadows (wrapped diffuse), because skin scatters light; red light reaches
/// farthest. Highlights use a microfacet model (Walter et al. 2007).
/// \param specular_factor  factor on the specular reflection.
LinearRgb shade(const ShadePoint& point, float specular_factor = 1);

/// Shades many points with SIMD, like `shade`. The result of a point is the same with every
/// instruction set and does not depend on the other points.
class ShadeBatch {
 public:
  /// Removes all points.
  void clear() { count_ = 0; }
  /// Adds a point to shade. \param specular_factor  factor on the specular reflection
  void add(const ShadePoint& point, float specular_factor);
  /// Computes the radiance of all points.
  void shade();

  /// Radiance of point `i`, counted from 0 in the order in which points were added. Requires a call
  /// of `shade`.
  LinearRgb radiance(std::size_t i) const {
    const float* at = lights_.data() + i / kBlockSize * 3 * kBlockSize + i % kBlockSize;
    return {at[0], at[kBlockSize], at[2 * kBlockSize]};
  }

  /// Numbers that describe a point. The points are stored in blocks of kBlockSize points. Within a
  /// block, the values of each field are contiguous.
  enum Field {
    kNormal,
    kToViewer = kNormal + 3,
    kAlbedo = kToViewer + 3,
    kWrap = kAlbedo + 3,  ///< Material::wrap
    kRoughness = kWrap + 3,
    kReflectance,  ///< Material::reflectance
    kKey,          ///< visible fraction of the key light
    kSky,          ///< visible fraction of the sky
    kSpecularFactor,
    kRadianceFactor,  ///< factor on the total radiance
    kFields           ///< number of numbers per point
  };
  static constexpr std::size_t kBlockSize = 16;  ///< number of points in a block

 private:
  std::size_t count_ = 0;      ///< number of points
  std::vector<float> points_;  ///< all fields of all points, indexed as [block][field][point]
  std::vector<float> lights_;  ///< radiance of all points, indexed as [block][channel][point]
};

}  // namespace crowdface
