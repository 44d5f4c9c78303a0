// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "crowdface/validity/intersections.h"

namespace crowdface {

/// From where a face is looked at, and how large it is.
struct Viewing {
  std::vector<Eigen::Vector3d> directions;  ///< towards viewers, of any length but zero
  double mm_per_unit = 1;
};

/// What is wrong with a face's skin against that of its target.
struct SkinDefects {
  LocalDefects local;
  Index intersecting = 0;  ///< triangles that pass through others, where the target's do not
  /// How much farther skin that nearly touches is apart than in any head; measured by whoever knows
  /// where it touches.
  double wider_mm = 0;
  double exposed_mm2 = 0;  ///< skin that shows its back, beyond the target's
};

/// Judges whole meshes of one topology against their targets, from any thread.
class SkinCheck {
 public:
  /// \param heads    #V by 3 each. \throws BrokenPrecondition if there is none.
  /// \param targets  heads that will be asked about.
  SkinCheck(const Topology& topology, const Components& components, const std::vector<Head>& heads,
            const std::set<Index>& targets, Viewing viewing);

  /// \param target  one of those named to the constructor.
  SkinDefects compare(const Positions& positions, Index target) const;
  /// Against a target that is none of the heads, as a mixture of them: twice the work.
  SkinDefects compare(const Positions& positions, const Positions& target) const;

  /// What this object itself takes.
  std::uint64_t memory_bytes() const;
  /// What one `compare` takes while it runs, at most: boxes and pairs.
  std::uint64_t compare_bytes() const;

 private:
  struct Target {
    TargetTriangles triangles;
    NewIntersections intersections;
    double exposed;
  };
  Target prepared(const Positions& positions) const;
  SkinDefects compare(const Positions& positions, const Target& target) const;

  std::vector<Triangle> triangles_;  ///< their backs to the inside
  TriangleTree tree_;
  FacesAround around_;
  Viewing viewing_;
  std::map<Index, Target> targets_;
};

}  // namespace crowdface
