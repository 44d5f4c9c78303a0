// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "crowdface/validity/intersections.h"

namespace crowdface {

/// The directions from which the skin is viewed to measure how much of its back side is visible,
/// and the length of the mesh's unit.
struct ViewSetup {
  /// Directions towards the viewers, of any non-zero length.
  std::vector<Eigen::Vector3d> directions;
  double mm_per_unit = 1;
};

/// Defects of a face's skin compared with its target's skin.
struct SkinDefects {
  LocalDefects local;      ///< defects of single triangles
  Index intersecting = 0;  ///< triangles in intersections that the target does not have
  /// How much a gap at a contact of the skin (such as between the lips) exceeds the widest gap of
  /// any head at the same contact. Not set by SkinCheck, but by callers that know the contacts.
  double gap_excess_mm = 0;
  double exposed_mm2 = 0;  ///< visible area of the skin's back side, in excess of the target's
};

/// Compares meshes of one topology with their targets. Const methods are thread-safe.
class SkinCheck {
 public:
  /// \param heads    each with #V by 3 positions; the first one determines which side of the skin
  ///                 is outside.
  /// \param targets  indices of the heads that `compare` may name.
  /// \throws BrokenPrecondition if there is no head.
  SkinCheck(const Topology& topology, const Components& components, const std::vector<Head>& heads,
            const std::set<Index>& targets, ViewSetup view_setup);

  /// Compares positions with a target.
  /// \param target  one of the targets passed to the constructor.
  SkinDefects compare(const Positions& positions, Index target) const;
  /// Compares positions with any target, such as a mixture of heads. Takes twice as long.
  SkinDefects compare(const Positions& positions, const Positions& target) const;

  /// Memory of this object in bytes.
  std::uint64_t memory_bytes() const;
  /// Upper bound of the temporary memory of one `compare` (boxes and pairs), in bytes.
  std::uint64_t compare_bytes() const;

 private:
  struct Target {
    TargetTriangles triangles;
    NewIntersections intersections;
    double exposed;
  };
  Target prepared_target(const Positions& positions) const;
  SkinDefects compare(const Positions& positions, const Target& target) const;

  std::vector<Triangle> triangles_;  ///< oriented with normals pointing outwards
  TriangleTree tree_;
  VertexFaces triangles_at_vertex_;
  ViewSetup view_setup_;
  std::map<Index, Target> targets_;
};

}  // namespace crowdface
