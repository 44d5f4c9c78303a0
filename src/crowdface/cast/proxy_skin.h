// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/sample_cells.h"
#include "crowdface/validity/intersections.h"

namespace crowdface {

/// The skin as the coarse mesh of its samples, on which faces are judged without being built.
class ProxySkin {
 public:
  /// \param mean   #S by 3, the mean head's samples in millimetres.
  /// \param heads  #S by 3 each, the targets.
  ProxySkin(std::vector<Triangle> triangles, const Positions& mean,
            const std::vector<Positions>& heads);

  /// What a face is compared with: a head's samples, or those of a mixture.
  struct Target {
    TargetTriangles triangles;  ///< for flips and stretch
    NewIntersections intersections;
  };
  const Target& head(Index head) const { return heads_[static_cast<std::size_t>(head)]; }
  Target target(const Positions& samples) const;

  /// Triangles that pass through others where the target's do not, among parts of the skin that lie
  /// near each other on the mean head without being neighbours on it: lips, lids, nostrils, folds.
  Index intersecting_triangles(const Positions& samples, const Target& target) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<TrianglePair> pairs_;
  std::vector<Target> heads_;
};

}  // namespace crowdface
