// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "crowdface/render/stage.h"

namespace crowdface {

/// How much of a light arrives, as found by rays towards it.
struct Openness {
  float open = 0;   ///< rays that reached it
  float asked = 0;  ///< of so many

  void add(const Openness& other, float weight) {
    open += weight * other.open;
    asked += weight * other.asked;
  }
};

/// A point of the surface that a camera ray has met.
struct Meeting {
  Eigen::Vector3f point;
  Eigen::Vector3f start;  ///< where rays to the lights begin
  ShadePoint surface;
  float skin_lightness = 0;  ///< of the picture on it, or 0
  bool asks_key = false;     ///< whether the key light could reach it at all
  Openness key, sky;
};

/// What is known of a place of the stage that a ray from the viewer has met.
Meeting meet(const Stage& stage, const RayHit& hit, const Eigen::Vector3f& direction);
/// The same of what the face wears, which looks alike from both sides.
Meeting meet_worn(const Stage& stage, const RayHit& hit, const Eigen::Vector3f& direction);

/// Asks memory for what `meet` will want of the hits that come soon: on a large mesh it lies in no cache.
void fetch_ahead(const Stage& stage, std::span<const std::optional<RayHit>> hits, std::size_t here);

}  // namespace crowdface
