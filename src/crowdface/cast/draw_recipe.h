// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/diversity.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/family.h"
#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/cast/typical_head.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Converts smoothness to smoothing iterations for a set of heads.
struct LevelScale {
  OperatorKind kind = OperatorKind::kUmbrella;
  std::uint64_t max_level = 1;  ///< L_max: iterations at smoothness 1
  /// root mean square edge length of the skin, averaged over the heads
  double edge_length_mm = 1;
};

/// All inputs of casting except the face space.
struct CastingOptions {
  std::string name;         ///< name of the crowd
  std::uint64_t count = 0;  ///< number of sampled faces
  std::uint64_t seed = 1;
  std::vector<PlanePoint> anchors;        ///< #heads
  std::vector<std::string> region_names;  ///< "all" if there are no regions
  SamplingOptions sampling;
  std::vector<ManualRecipe> recipes;
  Normalization normalization = Normalization::kPartition;
  LevelScale scale;
  DiversityOptions diversity = {};
  std::vector<FamilyOptions> families = {};
  std::vector<Review> reviews = {};          ///< applied one after the other
  std::vector<Group> groups = {};            ///< groups of the sampled faces
  HeadTags tags = {};                        ///< #heads, or empty
  std::vector<TraitTarget> population = {};  ///< requested distributions of measurements
  std::vector<FaceChange> changes = {};      ///< applied after all reviews
};

/// The distribution of a random face: the parameters of the crowd or of a group, and the possible
/// targets.
struct FaceKind {
  const SamplingOptions* sampling = nullptr;
  std::vector<WeightedHead> targets;
  std::optional<std::string> group;
  /// For each band, the heads that lend detail. If the list or a band's entry is empty, the sources
  /// in `sampling` apply.
  std::vector<std::vector<Index>> sources = {};
};
/// Returns the heads that lend detail to a band of a face of this kind.
const std::vector<Index>& sources_of(const FaceKind& kind, std::size_t band);
/// Returns the parameters of a group's faces, or of the crowd's faces if `group` is empty.
FaceKind kind_of_group(const CastingOptions& casting,
                       std::optional<std::size_t> group = std::nullopt);

/// Returns smoothness · L_max, rounded to whole iterations.
std::uint64_t iterations_of(double smoothness, const LevelScale& scale);

/// Returns the weights of a hand-written recipe, divided by their sum.
std::vector<SourceWeight> written_weights(const std::vector<WeightedHead>& written);

/// Returns the id of sampled face `index`: the crowd's name and at least four digits.
std::string face_id(const std::string& crowd, std::uint64_t index);

/// Key of a face's random numbers. Each combination has independent numbers.
struct FaceRandomKey {
  std::uint64_t index = 0;    ///< index of the face, from 1
  std::uint32_t attempt = 0;  ///< number of earlier rejected attempts at this face
  /// Empty for a sampled face. Otherwise a text that is unique to this face, such as "recipe/ID".
  std::string owner = {};
};

/// Chooses at random everything that `manual` does not specify; for a sampled face, `manual` specifies
/// nothing. A pure function of its arguments, so a face does not depend on the crowd's size or on
/// the order of the calls.
FacePlan random_face_plan(const CastingOptions& casting, const ManualRecipe& manual,
                          const FaceRandomKey& key, const FaceKind& kind);

/// Returns candidate number `attempt` for sampled face number `index`, which counts from 1.
FacePlan random_face(const CastingOptions& casting, std::uint64_t index, std::uint32_t attempt,
                     const FaceKind& kind);

/// Completes a hand-written recipe. Random numbers depend on the recipe's id.
///
/// \throws BrokenPrecondition if its weights cannot be normalised.
FacePlan completed_face_plan(const CastingOptions& casting, const ManualRecipe& manual,
                             std::uint32_t attempt = 0);

}  // namespace crowdface
