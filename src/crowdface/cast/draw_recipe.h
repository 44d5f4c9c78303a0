// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/ageing.h"
#include "crowdface/cast/diversity.h"
#include "crowdface/cast/face_plan.h"
#include "crowdface/cast/family.h"
#include "crowdface/cast/review.h"
#include "crowdface/cast/sampling.h"
#include "crowdface/cast/typical_head.h"
#include "crowdface/smooth/smoothing_operator.h"

namespace crowdface {

/// Converts a smoothness (0 … 1) to a number of smoothing iterations.
struct SmoothingLevelScale {
  OperatorKind operator_kind = OperatorKind::kUmbrella;
  std::uint64_t max_level = 1;  ///< L_max: number of iterations at smoothness 1
  /// root mean square edge length of the skin, averaged over the heads
  double edge_length_mm = 1;
};

/// All inputs of casting except the face space.
struct CastingOptions {
  std::string name;         ///< name of the crowd
  std::uint64_t count = 0;  ///< number of sampled faces
  std::uint64_t seed = 1;
  std::vector<PlanePoint> anchors;        ///< position of each head on the weight plane
  std::vector<std::string> region_names;  ///< contains only "all" if there are no regions
  SamplingOptions sampling;
  std::vector<ManualRecipe> recipes;
  Normalization normalization = Normalization::kPartition;
  SmoothingLevelScale level_scale;
  DiversityOptions diversity = {};
  std::vector<FamilyOptions> families = {};
  std::vector<Review> reviews = {};  ///< reviews, which are applied one after the other
  std::vector<Group> groups = {};    ///< groups of the sampled faces
  HeadTags tags = {};                ///< the tags of each head; or empty
  /// distributions that the measurements of the crowd should have
  std::vector<TraitTarget> trait_targets = {};
  std::vector<FaceChange> changes = {};      ///< changes of single faces that the config requests
  std::vector<double> head_ages_years = {};  ///< the age of each head; or empty
};
/// Returns the properties of the heads on which ageing depends.
inline HeadProperties properties_of_heads(const CastingOptions& casting) {
  return {casting.anchors, casting.tags, casting.head_ages_years};
}

/// The distribution from which a face is drawn: the parameters of the crowd or of a group, and the
/// possible targets.
struct FaceDistribution {
  const SamplingOptions* sampling = nullptr;
  std::vector<WeightedHead> targets;
  std::optional<std::string> group;
  /// For each band, the heads that lend detail. A band that has no entry, or an empty entry, has
  /// the sources of `sampling`.
  std::vector<std::vector<Index>> sources = {};
};
/// Returns the heads that lend detail to a band of a face from this distribution.
const std::vector<Index>& sources_of(const FaceDistribution& distribution, std::size_t band);
/// Returns the distribution of a group's faces. If `group` is empty, returns the distribution of
/// the faces that have no group.
FaceDistribution distribution_of_group(const CastingOptions& casting,
                                       std::optional<std::size_t> group = std::nullopt);

/// Returns smoothness · L_max, rounded to whole smoothing iterations.
std::uint64_t iterations_of(double smoothness, const SmoothingLevelScale& scale);

/// Scales the weights of a hand-written recipe so that they sum to one.
std::vector<SourceWeight> normalized_source_weights(const std::vector<WeightedHead>& written);

/// Returns the id of sampled face `index`: the crowd's name and at least four digits.
std::string face_id(const std::string& crowd, std::uint64_t index);

/// Key of a face's random numbers. Each combination of the three members gives independent numbers.
struct FaceRandomKey {
  /// number of the sampled face or of the family's member, from 1; 0 for other faces
  std::uint64_t index = 0;
  /// number of candidates for this face that were generated before this candidate
  std::uint32_t attempt = 0;
  /// Text that precedes the purpose of each random number, such as "recipe/ID" for a hand-written
  /// recipe or "family/NAME" for a member of a family. Empty for a sampled face.
  std::string purpose_prefix = {};
};

/// Chooses at random all values that `manual` does not specify; for a sampled face, `manual`
/// specifies nothing. A pure function of its arguments: a face depends neither on the size of the
/// crowd nor on the order of the calls.
FacePlan random_face_plan(const CastingOptions& casting, const ManualRecipe& manual,
                          const FaceRandomKey& key, const FaceDistribution& distribution);

/// Returns candidate number `attempt` for sampled face number `index`, which counts from 1.
FacePlan random_face(const CastingOptions& casting, std::uint64_t index, std::uint32_t attempt,
                     const FaceDistribution& distribution);

/// Chooses at random all values that a hand-written recipe does not specify. The random numbers
/// depend on the recipe's id.
///
/// \throws BrokenPrecondition if the recipe's weights cannot be scaled to a sum of one.
FacePlan completed_face_plan(const CastingOptions& casting, const ManualRecipe& manual,
                             std::uint32_t attempt = 0);

}  // namespace crowdface
