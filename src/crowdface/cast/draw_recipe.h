// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/cast/diversity.h"
#include "crowdface/cast/family.h"
#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/cast/typical_head.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// What turns a smoothness into iterations on this face set.
struct LevelScale {
  OperatorKind kind = OperatorKind::kUmbrella;
  std::uint64_t max_level = 1;  ///< L_max, what smoothness 1 stands for
  double edge_length_mm = 1;    ///< rms edge length of the skin, averaged over the face set
};

/// All that casting needs to know beside the face space.
struct Casting {
  std::string name;         ///< the crowd's
  std::uint64_t count = 0;  ///< sampled faces
  std::uint64_t seed = 1;
  std::vector<PlanePoint> anchors;        ///< #heads
  std::vector<std::string> region_names;  ///< "all" if there are no regions
  SamplingOptions sampling;
  std::vector<HandRecipe> recipes;
  Normalization normalization = Normalization::kPartition;
  LevelScale scale;
  DiversityOptions diversity = {};
  std::vector<FamilyOptions> families = {};
  std::vector<Review> reviews = {};  ///< one after the other
  std::vector<Group> groups = {};    ///< of sampled faces
  HeadTags tags = {};                ///< #heads, or none
};

/// What a face is drawn from: the numbers of the crowd or of a group, and what its target may be.
struct FaceKind {
  const SamplingOptions* sampling = nullptr;
  std::vector<WeightedHead> targets;
  std::optional<std::string> group;
  /// By bands, who lends in place of those that sampling names; empty, or empty for a band: as there.
  std::vector<std::vector<Index>> sources = {};
};
/// Heads that lend to a band of such a face.
const std::vector<Index>& sources_of(const FaceKind& kind, std::size_t band);
/// A face of that group, of none: by the numbers of the crowd.
FaceKind kind_of_group(const Casting& casting, std::optional<std::size_t> group = std::nullopt);

/// Whole iterations of a smoothness: the nearest to smoothness·L_max.
std::uint64_t iterations_of(double smoothness, const LevelScale& scale);

/// The id of sampled face `index`: the crowd's name and at least four digits.
std::string face_id(const std::string& crowd, std::uint64_t index);

/// Whose numbers are drawn: each combination has its own, whatever else is drawn.
struct DrawKey {
  std::uint64_t index = 0;    ///< of the face, from 1
  std::uint32_t attempt = 0;  ///< draws of this face thrown away before
  std::string who = {};       ///< empty for a sampled face; keeps the draws of others apart
};

/// Draws what `hand` leaves open; a sampled face leaves everything open. A pure function of the
/// arguments, so that a face is the same whatever the count or the order.
CastFace draw_recipe(const Casting& casting, const HandRecipe& hand, const DrawKey& key,
                     const FaceKind& kind);

/// Attempt `attempt` at sampled face `index` (from 1).
CastFace draw_face(const Casting& casting, std::uint64_t index, std::uint32_t attempt,
                   const FaceKind& kind);

/// A hand-written recipe; what it leaves open is drawn under its own name.
/// \throws BrokenPrecondition if its weights cannot be normalised.
CastFace draw_hand_recipe(const Casting& casting, const HandRecipe& hand,
                          std::uint32_t attempt = 0);

}  // namespace crowdface
