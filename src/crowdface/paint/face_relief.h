// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Points spread evenly over the skin by area, so that what is measured on them does not depend on how the mesh is cut.
/// \param skin  #V: which vertices are skin; a face of the mesh counts if its first corner is skin
/// \return #S by 3, at most `count`; empty if the skin has no area
Positions sample_skin(const Topology& topology, const Positions& positions,
                      const std::vector<bool>& skin, Index count);

/// Where the relief of a face is found on a surface.
struct ReliefMatch {
  /// Partial correlation between the depths of the surface and those of a mean face, after an offset, slopes and
  /// curvatures are removed from both: 1 for the mean face itself, about 0.7 to 0.95 for faces, below 0.6 elsewhere.
  double agreement = -1;
  HeadAxes axes;            ///< how the face stands: found
  Eigen::Vector3d between;  ///< the point of the surface between the eyes
  double scale = 1;         ///< units of the positions per millimetre of the mean face
};

/// Agreement that a face has at least.
inline constexpr double kLeastAgreement = 0.6;

/// Searches the surface for the relief of a face (nose, eye sockets, mouth and chin; normalised cross-correlation with
/// the depths of a mean face): of any size, and turned by up to some 35° from one of `axes` in any direction. Turned faces
/// are searched only if no face stands straight.
/// \param samples  see sample_skin
/// \param eyes     centres of the eyeballs if known: a place for the eyes near to them is preferred
/// \return the best match, whatever its agreement is; nothing if there are no samples
std::optional<ReliefMatch> match_relief(const Positions& samples, const std::vector<HeadAxes>& axes,
                                        const std::vector<Eigen::Vector3d>& eyes);

}  // namespace crowdface
