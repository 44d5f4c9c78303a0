// SPDX-License-Identifier: Apache-2.0
// Measures the faces of a config from their recipes.
#pragma once

#include <memory>
#include <vector>

#include "crowdface/cast/casting_result.h"
#include "crowdface/cast/crowd_statistics.h"
#include "crowdface/cast/trait_rules.h"
#include "crowdface/heads/prepare.h"
#include "crowdface/run/face_builder.h"
#include "crowdface/run/head_traits.h"

namespace crowdface {

/// Measures faces at the landmarks of some measurements.
class FaceTraits {
 public:
  /// \param traits  indices of the measurements, all available
  /// \param config, inputs, prepared  must outlive this object
  FaceTraits(const Config& config, const Inputs& inputs, const Prepared& prepared,
             const HeadLandmarks& landmarks, std::vector<std::size_t> traits);
  FaceTraits(const FaceTraits&) = delete;
  FaceTraits& operator=(const FaceTraits&) = delete;

  const FaceMeasurer& measurer() const { return *measurer_; }
  const std::vector<std::size_t>& traits() const { return traits_; }
  /// The values of all traits, as on the mesh that is written for the recipe.
  std::vector<double> values(const Recipe& recipe) const;

 private:
  Positions exact_landmarks(const Recipe& recipe) const;
  /// Replaces the rows of wanted_ by those of the mirrored face.
  void mirror_wanted(Positions& face) const;

  std::vector<std::size_t> traits_;
  HeadLandmarks landmarks_;
  FaceBuilder builder_;
  double mm_per_unit_;
  std::shared_ptr<const MirrorMap> mirror_;
  std::shared_ptr<const HeadsOnBody> neck_;
  /// the vertices of the landmarks, and of the ring at the neck if there is one
  std::vector<std::uint32_t> wanted_;
  /// the vertices that the exact landmarks depend on, ascending, and the heads there
  FaceSamples samples_;
  SampledHeads heads_;
  Index vertex_count_;
  std::optional<FaceMeasurer> measurer_;
};

/// Returns the measurements that the config names, ready for measuring faces; null if it names none.
/// \throws UsageError if one of them is not available.
std::unique_ptr<const FaceTraits> named_face_traits(const Config& config, const Inputs& inputs,
                                                    const Prepared& prepared);

/// Returns the measurer of all traits that are available on the heads; null if none is.
/// \throws UsageError if the config names one that is not available.
std::unique_ptr<const FaceTraits> available_face_traits(const Config& config, const Inputs& inputs,
                                                        const Prepared& prepared);

/// What casting reached of the limits that could not be met: a line for each limit, with the share
/// of drawn faces that meet it, their range, and the heads that reach farthest.
/// \param shortfall  names the group, family or recipe whose limits bind
std::vector<std::string> trait_advice(const Config& config, const Inputs& inputs,
                                      const CastingOptions& casting, const FaceTraits& traits,
                                      const Shortfall& shortfall);

/// The landmarks of faces as casting draws them, without limits and constraints.
std::vector<Positions> drawn_landmarks(const CastingOptions& casting, const FaceMeasurer& measurer);

/// A measurement of the faces of a crowd, for reports.
struct TraitReport {
  std::size_t trait = 0;
  Quartiles heads, crowd;
  /// Only for a measurement with an asked distribution: the largest difference between it and that
  /// of the sampled faces (Kolmogorov and Smirnov), and the share of the asked distribution that
  /// lies below and above the values of drawn faces.
  struct Asked {
    TraitTarget target;
    double mean = 0, deviation = 0;  ///< of the sampled faces
    double difference = 0, below = 0, above = 0;
  };
  std::optional<Asked> asked;
};
/// \param crowd  measured faces, see measure_faces
std::vector<TraitReport> report_traits(const CastingOptions& casting, const FaceTraits& traits,
                                       const std::vector<FacePlan>& crowd);

/// Warnings about asked distributions that the crowd does not have.
std::vector<std::string> population_warnings(const std::vector<TraitReport>& reports);

/// A readable table of the ranges that faces of these heads fill, for all measurements.
std::string format_trait_ranges(const Config& config, const Inputs& inputs,
                                const Prepared& prepared, const CastingOptions& casting);

/// Records the values of all traits in the faces of a crowd.
void measure_faces(const FaceTraits& traits, std::vector<FacePlan>& crowd);

}  // namespace crowdface
