// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/sample_cells.h"
#include "crowdface/validity/intersections.h"

namespace crowdface {

/// A coarse mesh of the skin, whose vertices are the samples. Faces are judged on this mesh, so
/// that their whole meshes need not be built.
class ProxySkin {
 public:
  /// \param mean   #S by 3, samples of the mean head in millimetres.
  /// \param heads  #S by 3 each, samples of the heads that may be targets.
  ProxySkin(std::vector<Triangle> triangles, const Positions& mean,
            const std::vector<Positions>& heads);

  /// The target of a face (the samples of a head or of a mixture), prepared for comparison with the
  /// face.
  struct Target {
    /// the target's triangles, with which flips and stretch are measured
    TargetTriangles triangles;
    NewIntersections intersections;
  };
  const Target& target_of_head(Index head) const {
    return head_targets_[static_cast<std::size_t>(head)];
  }
  Target target_of_samples(const Positions& samples) const;

  /// Returns the number of triangles that take part in intersections that the target does not have.
  /// Considers only pairs of triangles that are near each other on the mean head but are not
  /// neighbours, as at lips, lids, nostrils and folds.
  Index intersecting_triangles(const Positions& samples, const Target& target) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<TrianglePair> nearby_pairs_;
  std::vector<Target> head_targets_;
};

}  // namespace crowdface
