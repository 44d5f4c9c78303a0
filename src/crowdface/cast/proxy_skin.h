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
  /// \param mean   #S by 3, positions of the samples on the mean head, in millimetres.
  /// \param heads  For each head that may be a target: #S by 3, positions of the samples on this
  ///               head.
  ProxySkin(std::vector<Triangle> triangles, const Positions& mean,
            const std::vector<Positions>& heads);

  /// The skin of a face's target (a head or a mixture of heads), prepared for comparison with the
  /// face's skin.
  struct ReferenceSkin {
    /// the target's triangles, with which the triangles of a face are compared to find flipped and
    /// stretched triangles
    TargetTriangles triangles;
    NewIntersections intersections;  ///< counts intersections that the target does not have
  };
  /// \param head  index into the constructor's `heads`
  const ReferenceSkin& reference_skin_of_head(Index head) const {
    return reference_skins_of_heads_[static_cast<std::size_t>(head)];
  }
  /// Makes the reference skin of a target that is a mixture of heads. (The constructor makes the
  /// reference skins of single heads.)
  /// \param samples  #S by 3, positions of the samples on the target, in millimetres
  ReferenceSkin make_reference_skin(const Positions& samples) const;

  /// Returns the number of triangles that take part in intersections which the reference skin does
  /// not have. Considers only pairs of triangles that are near each other on the mean head but are
  /// not neighbours, as at lips, lids, nostrils and folds.
  ///
  /// \param samples  #S by 3, positions of the samples on the face, in millimetres
  Index count_newly_intersecting_triangles(const Positions& samples,
                                           const ReferenceSkin& reference) const;

 private:
  std::vector<Triangle> triangles_;
  /// pairs of triangles that are checked for intersection
  std::vector<TrianglePair> nearby_pairs_;
  std::vector<ReferenceSkin> reference_skins_of_heads_;
};

}  // namespace crowdface
