// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "crowdface/cast/casting_options.h"
#include "crowdface/cast/face_plan.h"

namespace crowdface {

/// The distribution from which a face is drawn: the parameters of the crowd or of a group, and the
/// possible targets.
struct FaceDistribution {
  const SamplingOptions* sampling = nullptr;  ///< parameters of the crowd or of the group
  std::vector<WeightedHead> targets;          ///< possible targets, with their frequencies
  std::optional<std::string> group;           ///< name of the group; empty: no group
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

/// Returns the distribution of the faces that have no group, followed by the distribution of each
/// group's faces.
std::vector<FaceDistribution> face_distributions(const CastingOptions& casting);

/// Multiplies a smoothness (a fraction from 0 to 1) by the largest number of smoothing iterations
/// of `scale`, and rounds the result to whole iterations.
std::uint64_t iterations_of(double smoothness, const SmoothingLevelScale& scale);

/// Scales the weights of a hand-written recipe so that they sum to one.
std::vector<SourceWeight> normalized_source_weights(const std::vector<WeightedHead>& written);

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
