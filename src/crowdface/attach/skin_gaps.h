// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// The distance of each vertex of an attachment from the skin to which the attachment was fitted.
class SkinGaps {
 public:
  /// \param skin      Must outlive this object.
  /// \param topology  Topology of the attachment.
  /// \param points    #P by 3, on the fitted mesh.
  SkinGaps(const FittedSkin& skin, const Topology& topology, const Positions& points);

  /// A vertex that is too near to the skin or inside the skin.
  struct Violation {
    std::uint32_t vertex;  ///< index of the attachment's vertex
    /// minimum distance of the vertex from the skin, minus its present distance
    double missing_height;
    Eigen::Vector3d outward_normal;  ///< unit normal of the skin at the point nearest to the vertex
  };
  /// Returns the vertices of the attachment that were outside the skin of the fitted mesh and are
  /// now nearer to the face's skin than their minimum distance. The minimum distance of a vertex is
  /// its original distance or two millimetres, whichever is smaller.
  ///
  /// \param face     Positions of the face, #V by 3.
  /// \param normals  Normals of the face, from FittedSkin::normals.
  /// \param points   Present positions of the attachment's vertices, #P by 3.
  std::vector<Violation> violations(const Positions& face, const Positions& normals,
                                    const Positions& points) const;

  /// Moves points of the attachment so that points close to the fitted skin get their original
  /// distance from the skin again, and points outside the fitted skin keep at least their minimum
  /// distance (see `violations`). Neighbours of moved points move too.
  ///
  /// \param face     #V by 3.
  /// \param normals  Normals of the face, from FittedSkin::normals.
  /// \param points   #P by 3, on the face.
  void restore_gaps(const Positions& face, const Positions& normals, Positions& points) const;

  std::size_t memory_bytes() const;

 private:
  /// Returns the smallest distance from the skin that a point may have, see `violations`.
  double min_height(std::uint32_t point) const;

  const FittedSkin& skin_;
  /// signed distance of each point from the skin of the fitted mesh; infinite if the point is far
  /// from the skin
  std::vector<double> heights_;
  /// a skin vertex near each point, where the search for the nearest skin starts
  std::vector<std::uint32_t> start_vertices_;
  Adjacency neighbours_;  ///< neighbours of each point in the attachment's mesh
};

}  // namespace crowdface
