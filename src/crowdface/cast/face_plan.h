// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/hair_colour.h"

namespace crowdface {

/// The head and the earlier face that are nearest to a face. The attachments of a sampled face
/// depend on `earlier_face`.
struct NearestNeighbours {
  Index head = 0;               ///< index of the nearest input head
  double head_distance_mm = 0;  ///< distance between the face and `head`
  /// id of the nearest of the faces before this face in the plan; for a face that replaces a
  /// rejected face: of all other faces
  std::optional<std::string> earlier_face;
  double earlier_face_distance_mm = 0;  ///< distance between the face and `earlier_face`
};

/// How casting found a face. The face's mesh does not depend on these notes.
struct CastingNotes {
  /// number of candidates for this face that were generated before this candidate
  std::uint32_t attempt = 0;
  std::optional<NearestNeighbours> nearest;
  std::optional<std::string> review;  ///< the note that a reviewer wrote about this face
  /// The changes of the face, in order. Each text names the origin and the config keys of a change,
  /// such as "review 2: age, hair".
  std::vector<std::string> changes = {};
};

/// The plan of one face, which is one line of the crowd's plan.
struct FacePlan {
  std::string id;
  /// number of the sampled face, from 1; empty if the face is not sampled
  std::optional<std::uint64_t> index;
  std::optional<std::string> family;  ///< name of the family of which the face is a member
  std::optional<std::string> group;   ///< name of the group that the face belongs to
  Recipe recipe;
  /// The age that apply_age has given to the face: from −1 (young) to 1 (old), where 0 changes
  /// nothing. Empty if apply_age did not change the face.
  std::optional<double> age;
  /// the wanted age in years; empty if the wanted age was not given in years
  std::optional<double> age_years;
  /// mother and father, if the face's family has parents: names of heads or ids of faces
  std::vector<std::string> parents;
  /// one entry for each band of each region, region by region: name of the parent from whom the
  /// detail comes; empty without parents
  std::vector<std::string> inherited_from;
  /// mother's fraction of the coarse shape, if the face inherits its coarse shape
  double mother_share = 0;
  std::vector<std::string> attachments;  ///< names of the attachments
  /// values of the measurements that PlanNames::traits lists; empty: not measured
  std::vector<double> traits = {};
  /// hair colour; empty if the face cannot wear attachments with a tint
  std::optional<HairColour> hair;
  CastingNotes notes;
};

}  // namespace crowdface
