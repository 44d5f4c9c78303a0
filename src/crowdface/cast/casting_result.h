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

/// Why casting stopped before all faces were found: the face that could not be cast, and how often
/// each constraint rejected a candidate.
struct Shortfall {
  enum class What { kSampledFace, kManualRecipe, kFamily, kRedrawnFace, kChangedFace };
  std::uint64_t cast_count = 0;  ///< number of sampled faces that were cast
  /// how often each constraint rejected a candidate for the face that could not be cast
  RejectionCounts rejections;
  /// If `what` is kSampledFace: index of the group of the face that could not be cast, or −1 if
  /// this face has no group. Otherwise −1.
  int group_index = -1;
  What what = What::kSampledFace;  ///< what could not be cast
  /// name of the family, or id of the face, that could not be cast; empty for a sampled face
  std::string name = {};
};

struct ChangedFace;

/// A change of a face, and its origin.
struct AppliedChange {
  FaceChange change;
  std::string origin;  ///< source of the change: "config", or a review such as "review 2"
  /// If the change turns the face into a variant of another face (the original): a copy of the
  /// original. The copy was made before any change with the same `origin` as this change was
  /// applied. Null for all other changes.
  std::shared_ptr<const ChangedFace> variant_of;
  /// smallest allowed distance between the changed face and the faces before it in the plan
  double min_distance_mm = 0;
};

/// A face after the changes that the config and reviews request.
struct ChangedFace {
  FacePlan face;           ///< the face's plan; its colours and attachments are not set
  FaceSpace::Point point;  ///< point of the changed face in the face space
  /// the changes, in the order in which casting applied them: first the changes of the config
  std::vector<AppliedChange> changes = {};
  /// limits on the face's measurements, merged from all of `changes` (merge_limits)
  TraitLimits traits = {};
  /// whether the face was redrawn, so that it now shows another person
  bool is_other_person = false;
  /// the original, if this face is a variant of another face
  std::shared_ptr<const ChangedFace> variant_of = {};
};

/// The result of casting a crowd.
struct CastingResult {
  /// all faces: first the faces of recipes, then of families, then the sampled faces 1 … count
  std::vector<FacePlan> crowd;
  std::vector<FaceSpace::Point> points;  ///< each face's point in the face space
  std::vector<int> group_indices;        ///< for each sampled face: index of its group, or −1
  std::vector<FamilyPlan> families;      ///< families of the crowd, in the order of the config
  /// faces that reviews rejected, in the order of rejection; a face and its replacement have the
  /// same id
  std::vector<FacePlan> rejected;
  /// for each rejected face, the size of the crowd when the face was rejected
  std::vector<std::size_t> crowd_size_at_rejection;
  /// Changed faces, by index in `crowd`. (`crowd` itself holds the faces without their changes, and
  /// no other face depends on a change.)
  std::map<std::size_t, ChangedFace> changed = {};
  /// how often each constraint rejected a candidate; the sum over all faces
  RejectionCounts rejections;
  std::optional<Shortfall> shortfall;  ///< set if casting stopped early
};

/// Casting handles the sampled faces in blocks of at most this number of faces. Generates the
/// candidates for all faces of a block in parallel, and then chooses the faces one after the other.
inline constexpr std::uint64_t kFacesCastInParallel = 64;

/// Called after each sampled face that joins the crowd; may be empty.
///
/// \param rejected  The candidates for this face that were rejected; there are many if the crowd is
///                  nearly full.
using FaceJoinedCallback = std::function<void(const RejectionCounts& rejected)>;

}  // namespace crowdface
