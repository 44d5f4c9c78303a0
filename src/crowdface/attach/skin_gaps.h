// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/attach/fitted_skin.h"
#include "crowdface/mesh/adjacency.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// How far each vertex of an attachment is off the skin it was fitted to.
class SkinGaps {
 public:
  /// \param skin     must outlive this object.
  /// \param topology of the attachment.
  /// \param points   #P by 3, beside the fitted mesh.
  SkinGaps(const FittedSkin& skin, const Topology& topology, const Positions& points);

  /// A vertex that is nearer to the skin than it may be.
  struct Missing {
    std::uint32_t vertex;
    double height;            ///< what it lacks
    Eigen::Vector3d outward;  ///< off the skin, unit
  };
  /// Vertices that were off the skin and are in it now, or much nearer to it than they were.
  std::vector<Missing> missing(const Positions& face, const Positions& normals,
                               const Positions& points) const;

  /// Gives what lies on the skin the gap that it had, and pushes out what has come to lie in it or too
  /// near to it. What is pushed takes its neighbours with it.
  void restore(const Positions& face, const Positions& normals, Positions& points) const;

  std::size_t memory_bytes() const;

 private:
  double least_height(std::uint32_t point) const;

  const FittedSkin& skin_;
  std::vector<double> heights_;  ///< #P, of the gaps; far from the skin not known and infinite
  std::vector<std::uint32_t> starts_;  ///< #P, vertices of the skin near them
  Adjacency neighbours_;               ///< #P
};

}  // namespace crowdface
