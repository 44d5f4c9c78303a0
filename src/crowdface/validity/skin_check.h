// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "crowdface/validity/intersections.h"

namespace crowdface {

/// From where visible areas of a face are measured (as for viewers who look at the face), and the
/// length of one unit of the positions.
struct ViewSetup {
  /// Directions towards the viewers, of any non-zero length.
  std::vector<Eigen::Vector3d> directions;
  double mm_per_unit = 1;  ///< millimetres per unit of the positions
};

/// Defects of a face's skin compared with its target's skin.
struct SkinDefects {
  LocalDefects local;  ///< flipped and stretched triangles of the skin
  /// number of triangles that take part in intersections which the target does not have
  Index intersecting_triangle_count = 0;
  /// How much the gap at a contact of the skin (such as between the lips) exceeds the widest gap of
  /// any head at the same contact. SkinCheck does not set this value; callers that know the
  /// contacts set it.
  double gap_excess_mm = 0;
  /// increase of the visible area of the skin's back side, compared with the target
  double exposed_back_face_mm2 = 0;
};

/// Compares the skin of meshes that have the same topology with the skin of their targets. Const
/// methods are thread-safe.
class SkinCheck {
 public:
  /// \param heads    #V by 3 positions each. The first head determines which side of the skin is
  ///                 outside.
  /// \param targets  indices of the heads that may be passed to `compare` as targets.
  /// \throws BrokenPrecondition if there is no head.
  SkinCheck(const Topology& topology, const Components& components, const std::vector<Head>& heads,
            const std::set<Index>& targets, ViewSetup view_setup);

  /// Compares a face with one of the heads.
  ///
  /// \param target  index of a head that was passed to the constructor as a target.
  SkinDefects compare(const Positions& positions, Index target) const;
  /// Compares a face with any target, such as a mixture of heads. Takes twice as long as a
  /// comparison with a target that was passed to the constructor.
  SkinDefects compare(const Positions& positions, const Positions& target) const;

  /// Returns the memory that this object uses, in bytes.
  std::uint64_t memory_bytes() const;
  /// Returns an upper bound of the temporary memory that one `compare` uses (for boxes and pairs),
  /// in bytes.
  std::uint64_t comparison_memory_bytes() const;

 private:
  /// The data of a target with which faces are compared.
  struct Target {
    TargetTriangles triangles;  ///< the target's triangles, to measure local defects of faces
    /// counts the intersections of a face that the target does not have
    NewIntersections intersections;
    /// visible area of the back side of the target's skin, in the square of the positions' unit
    double exposed_back_area;
  };
  /// Computes the data of a target. \param positions  the target's positions, #V by 3
  Target prepared_target(const Positions& positions) const;
  /// Compares a face with a prepared target.
  SkinDefects compare(const Positions& positions, const Target& target) const;

  /// the skin's triangles, oriented so that their normals point outwards
  std::vector<Triangle> triangles_;
  TriangleTree tree_;                ///< tree of `triangles_`
  VertexFaces triangles_at_vertex_;  ///< triangles at each vertex: indices into `triangles_`
  ViewSetup view_setup_;  ///< the viewers for which the visible area of the back side is measured
  std::map<Index, Target> targets_;  ///< the data of each target; the key is the head's index
};

}  // namespace crowdface
