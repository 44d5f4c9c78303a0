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

  /// Flips and stretch against the target.
  LocalDefects local(const Positions& samples, Index target) const;
  /// Triangles that pass through others where the target's do not, among parts of the skin that lie
  /// near each other on the mean head without being neighbours on it: lips, lids, nostrils, folds.
  Index intersecting_triangles(const Positions& samples, Index target) const;

 private:
  std::vector<Triangle> triangles_;
  std::vector<TrianglePair> pairs_;
  std::vector<TargetTriangles> targets_;
  std::vector<NewIntersections> target_intersections_;
};

}  // namespace crowdface
