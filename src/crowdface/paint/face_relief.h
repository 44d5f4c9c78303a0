// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

inline constexpr Index kSkinSamples = 150'000;  ///< enough for a face on a bust

/// Points spread evenly over the skin by area, so that what is measured on them does not depend on how the mesh is cut.
/// \param skin  #V: which vertices are skin; a face of the mesh counts if its first corner is skin
/// \return #S by 3, at most `count`; empty if the skin has no area
Positions sample_skin(const Topology& topology, const Positions& positions,
                      const std::vector<bool>& skin, Index count);

/// Where the relief of a face is found on a surface.
struct ReliefMatch {
  /// Partial correlation between the depths of the surface and those of a mean face, after an offset, slopes and
  /// curvatures are removed from both: 1 for the mean face itself, 0.75 to 0.97 for faces, seldom above 0.6 elsewhere.
  double agreement = -1;
  /// The agreement, and 0.15 more or less if eyeballs are known and lie where this face has its eyes, or do not.
  double votes = -1;
  std::size_t view = 0;     ///< index of the requested axes nearest to the face's own
  double degrees_off = 0;   ///< angle between these axes and the face's own
  HeadAxes axes;            ///< the face's own; the requested ones if they differ by less than 5°
  Eigen::Vector3d between;  ///< the point of the surface between the eyes
  double scale = 1;         ///< units of the positions per millimetre of the mean face, across
  double stretch = 1;       ///< up, as a multiple of scale
};

/// A match with fewer votes is not a face.
inline constexpr double kLeastVotes = 0.65;
/// A match that is turned by more degrees from the requested axes is not accepted as a face along these axes.
inline constexpr double kMostDegreesOff = 45;

/// Searches the surface for the relief of a face (nose, eye sockets, mouth and chin; normalised cross-correlation with
/// the depths of a mean face): of any size, and turned by up to some 35° from one of `axes` in any direction. Turned faces
/// are searched only if no face stands straight.
/// \param samples  see sample_skin
/// \param eyes     centres of the eyeballs if known: they vote for a face or against it
/// \return the match with the most votes, however few; nothing if there are no samples
std::optional<ReliefMatch> match_relief(const Positions& samples, const std::vector<HeadAxes>& axes,
                                        const std::vector<Eigen::Vector3d>& eyes);

}  // namespace crowdface
