// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/cast/face_samples.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {

/// Where faces lie at the samples, computed from recipes alone: enough to tell how far apart two
/// faces are without building a mesh. Every face is aligned rigidly to the mean head there, which
/// matches pairwise alignment closely (design notes in docs/method.md).
class FaceSpace {
 public:
  /// One face: its samples in millimetres, aligned, as built and with every extrapolation factor
  /// set to 1 (extrapolation alone does not make another person).
  struct Place {
    Eigen::VectorXf as_built;
    Eigen::VectorXf unit;
  };

  /// \param trajectories   one for each head, see sample_trajectory.
  /// \param mm_per_unit    millimetres in one unit of the heads' positions.
  FaceSpace(const FaceSet& faces, const RegionWeights& regions, FaceSamples samples,
            std::span<const Trajectory> trajectories, std::uint64_t max_level, double mm_per_unit);

  Place place(const Recipe& recipe) const;
  /// An input head, whose two places are one.
  Place place_head(Index head) const;

  /// Root mean square over the face in mm: the smaller of the distances between the faces as built
  /// and with factors of 1.
  double distance(const Place& a, const Place& b) const;

  /// Distances between all heads, #heads by #heads, in mm.
  Eigen::MatrixXd head_distances() const;

  /// For each recipe the nearest head and the nearest face before it.
  void find_nearest(std::vector<Recipe>& crowd) const;

 private:
  Positions smoothed_difference(const RegionRecipe& region, Index target,
                                double extrapolation) const;
  Eigen::VectorXf aligned(const Positions& samples) const;
  Positions samples_of(const Recipe& recipe, bool unit_extrapolation) const;

  std::vector<Positions> heads_;  ///< #S by 3 each
  Columns alpha_;                 ///< #S by #regions
  std::span<const Trajectory> trajectories_;
  std::vector<std::uint64_t> levels_;
  Positions mean_;  ///< #S by 3
  double mm_per_unit_;
};

}  // namespace crowdface
