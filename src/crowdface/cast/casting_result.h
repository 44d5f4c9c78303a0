// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/cast/constraints.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/face_space.h"
#include "crowdface/cast/families.h"
#include "crowdface/cast/review.h"

namespace crowdface {

/// The face at which casting stopped early, and the reason.
struct Shortfall {
  std::uint64_t reached = 0;       ///< number of sampled faces that were cast
  Rejections rejections;           ///< why candidates for the next face were rejected
  int kind = -1;                   ///< group of the sampled face that could not be found, or −1
  std::string family = {};         ///< name of the family that could not be cast, if any
  std::string reviewed_face = {};  ///< id of the face that could not be redrawn, if any
  std::string recipe = {};         ///< id of the hand-written face that could not be cast, if any
  std::string changed_face = {};   ///< id of the face that could not be changed, if any
};

struct ChangedFace;

/// A change of a face, and its origin.
struct AppliedChange {
  FaceChange change;
  std::string origin;  ///< who asks for the change, such as "review 2"
  /// If the change makes a variant: the original face, as it is before this change. Otherwise null.
  std::shared_ptr<const ChangedFace> variant_of;
  double min_distance_mm = 0;  ///< smallest distance of the changed face from the faces before it
};

/// A face after the changes that the config and reviews request.
struct ChangedFace {
  FacePlan face;  ///< without colours and attachments
  FaceSpace::Point point;
  std::vector<AppliedChange> changes = {};             ///< in order; changes of the config first
  TraitLimits traits = {};                             ///< the limits of all changes
  bool is_other_person = false;                        ///< whether the face was redrawn
  std::shared_ptr<const ChangedFace> variant_of = {};  ///< the face that this is a variant of
};

/// A cast crowd.
struct CastingResult {
  std::vector<FacePlan> crowd;           ///< recipes, then families, then sampled faces 1 … count
  std::vector<FaceSpace::Point> points;  ///< #crowd
  std::vector<int> kinds;                ///< group of each sampled face, or −1
  std::vector<FamilyPlan> families;
  std::vector<FacePlan> rejected;  ///< faces that reviews rejected, in order; ids as in `crowd`
  /// #rejected: size of the crowd when the face was rejected
  std::vector<std::size_t> crowd_size_at_rejection;
  /// Changed faces, by index in `crowd`; `crowd` itself holds the faces without changes. No other
  /// face depends on a change.
  std::map<std::size_t, ChangedFace> changed = {};
  Rejections rejections;
  std::optional<Shortfall> shortfall;
};

/// Number of sampled faces whose candidates are generated in parallel, before these faces are
/// chosen one after the other.
inline constexpr std::uint64_t kFacesCastInParallel = 64;

/// Called after each sampled face that joins the crowd; may be empty.
///
/// \param rejected  Rejected candidates for this face: many if the crowd is nearly full.
using FaceJoined = std::function<void(const Rejections& rejected)>;

}  // namespace crowdface
