// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "crowdface/render/head_scene.h"

namespace crowdface {

/// Results of the shadow rays from a surface point towards one light. The numbers of rays are
/// weighted sums if the results of several points are added.
struct Visibility {
  float unblocked_rays = 0;  ///< number of rays that reached the light
  float traced_rays = 0;     ///< number of rays traced

  /// Adds the results of another point, multiplied by `weight`.
  void add(const Visibility& other, float weight) {
    unblocked_rays += weight * other.unblocked_rays;
    traced_rays += weight * other.traced_rays;
  }
};

/// A surface point that a camera ray hits, with the data for shading it.
struct CameraHit {
  Eigen::Vector3f point;  ///< position in camera space
  /// origin of rays from this point to the lights, slightly above the surface
  Eigen::Vector3f ray_origin;
  ShadePoint surface;                  ///< normal, colour and material at the point
  float skin_lightness = 0;            ///< skin_lightness() of the texture at the hit, or 0
  bool can_receive_key_light = false;  ///< whether the key light can contribute at all
  Visibility key_visibility;           ///< results of the shadow rays towards the key light
  Visibility sky_visibility;           ///< results of the shadow rays towards the sky
};

/// Computes the surface data at a hit on the face. \param direction  direction of the camera ray.
CameraHit camera_hit(const HeadScene& scene, const RayHit& hit, const Eigen::Vector3f& direction);
/// Computes the surface data at a hit on an attachment, which looks the same from both sides.
CameraHit attachment_hit(const HeadScene& scene, const RayHit& hit,
                         const Eigen::Vector3f& direction);

/// Prefetches the data that shading needs for the hits after hit number `current`; large meshes do
/// not fit into the CPU caches.
void prefetch_hits(const HeadScene& scene, std::span<const std::optional<RayHit>> hits,
                   std::size_t current);

}  // namespace crowdface
