// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/sample_cells.h"
#include "crowdface/validity/intersections.h"

namespace crowdface {

/// The skin as a coarse mesh of its samples, on which faces are judged without building their
/// meshes.
class ProxySkin {
 public:
  /// \param mean   #S by 3, samples of the mean head in millimetres.
  /// \param heads  #S by 3 each, samples of the targets.
  ProxySkin(std::vector<Triangle> triangles, const Positions& mean,
            const std::vector<Positions>& heads);

  /// The target of a face, with which the face is compared: the samples of a head or of a mixture.
  struct Target {
    TargetTriangles triangles;  ///< the target's triangles, for flips and stretch
    NewIntersections intersections;
  };
  const Target& target_of_head(Index head) const { return heads_[static_cast<std::size_t>(head)]; }
  Target target_of_samples(const Positions& samples) const;

  /// Returns the number of triangles that intersect others where the target's triangles do not.
  /// Considers only triangles that are near each other on the mean head without being neighbours:
  /// lips, lids, nostrils, folds.
  Index intersecting_triangles(const Positions& samples, const Target& target) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<TrianglePair> pairs_;
  std::vector<Target> heads_;
};

}  // namespace crowdface
