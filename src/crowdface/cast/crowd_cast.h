// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/constraints.h"
#include "crowdface/cast/face_space.h"
#include "crowdface/cast/families.h"

namespace crowdface {

/// Where casting had to stop.
struct Shortfall {
  std::uint64_t reached = 0;  ///< sampled faces that were found
  Rejections rejections;      ///< why the next one's candidates were thrown away
  int kind = -1;              ///< which group the next one counts for, or −1
  std::string family = {};    ///< that could not be cast, if it was one
  std::string reviewed = {};  ///< the id of a face that could not be drawn anew, if it was one
};

/// A crowd that was cast.
struct CrowdCast {
  std::vector<CastFace> crowd;           ///< recipes, then families, then faces 1 … count
  std::vector<FaceSpace::Point> points;  ///< of each
  std::vector<int> kinds;                ///< which group each sampled face is of, or −1
  std::vector<FamilyCast> families;
  std::vector<CastFace> rejected;  ///< by reviews, in their order; ids as in the crowd
  Rejections rejections;
  std::optional<Shortfall> shortfall;
};

/// Told after each sampled face; nothing if empty.
/// \param thrown  its candidates that were thrown away: many where the crowd is nearly full.
using FaceJoined = std::function<void(const Rejections& thrown)>;

}  // namespace crowdface
