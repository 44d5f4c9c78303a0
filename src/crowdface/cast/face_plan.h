// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/hair_colour.h"

namespace crowdface {

/// The nearest head and the nearest earlier face of a face; for information only.
struct NearestNeighbours {
  Index head = 0;  ///< the nearest input head
  double head_distance_mm = 0;
  std::optional<std::string> earlier_face;  ///< id of the nearest earlier face in the plan
  double earlier_face_distance_mm = 0;
};

/// How casting found a face. Meshes do not depend on these notes.
struct CastingNotes {
  std::uint32_t attempt = 0;  ///< number of earlier, rejected candidates for this face
  std::optional<NearestNeighbours> nearest;
  std::optional<std::string> review;  ///< a reviewer's note
  /// Changes of the face, in order: who changed which keys, such as "review 2: age, hair".
  std::vector<std::string> changes = {};
};

/// A face of a crowd: one line of its plan.
struct FacePlan {
  std::string id;
  std::optional<std::uint64_t> index;  ///< from 1; empty if the face is not sampled
  std::optional<std::string> family;
  std::optional<std::string> group;
  Recipe recipe;
  std::optional<double> age;  ///< −1 … 1, if the face was aged
  /// mother and father, if the family has parents: names of heads or ids of faces
  std::vector<std::string> parents;
  /// #regions by #bands: the parent that the detail comes from; empty without parents
  std::vector<std::string> inherited_from;
  double mother_share = 0;  ///< mother's fraction of the coarse shape, if the face inherits it
  std::vector<std::string> attachments;  ///< names
  /// values of the measurements that the plan records (PlanNames::traits); empty: not measured
  std::vector<double> traits = {};
  std::optional<HairColour> hair;  ///< hair colour, if attachments of the face may have a tint
  CastingNotes notes;
};

}  // namespace crowdface
