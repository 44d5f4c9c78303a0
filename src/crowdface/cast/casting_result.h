// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/face_space.h"
#include "crowdface/cast/families.h"

namespace crowdface {

/// Where and why casting stopped early.
struct Shortfall {
  std::uint64_t reached = 0;  ///< number of sampled faces that were cast
  Rejections rejections;      ///< why candidates for the next face were rejected
  int kind = -1;              ///< group of the face that could not be found, or −1
  std::string family = {};    ///< name of the family that could not be cast, if any
  std::string reviewed = {};  ///< id of the face that could not be redrawn, if any
  std::string recipe = {};    ///< id of the hand-written face that could not be drawn, if any
};

/// A cast crowd.
struct CastingResult {
  std::vector<FacePlan> crowd;           ///< recipes, then families, then sampled faces 1 … count
  std::vector<FaceSpace::Point> points;  ///< #crowd
  std::vector<int> kinds;                ///< group of each sampled face, or −1
  std::vector<FamilyPlan> families;
  std::vector<FacePlan> rejected;  ///< faces that reviews rejected, in order; ids as in `crowd`
  /// #rejected: size of the crowd when the face was rejected; later faces joined afterwards
  std::vector<std::size_t> rejected_from;
  Rejections rejections;
  std::optional<Shortfall> shortfall;
};

/// Called after each sampled face that joins the crowd; may be empty.
///
/// \param thrown  Rejected candidates for this face: many if the crowd is nearly full.
using FaceJoined = std::function<void(const Rejections& thrown)>;

}  // namespace crowdface
