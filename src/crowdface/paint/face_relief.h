// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// number of samples with which a face is found even on a bust
inline constexpr Index kSkinSamples = 150'000;

/// Samples the skin evenly by area, so that measurements on the samples do not depend on the
/// tessellation of the mesh.
/// \param skin  #V: which vertices are skin; a polygon counts as skin if its first vertex does
/// \return #S by 3, at most `count` rows; empty if the skin has no area
Positions sample_skin(const Topology& topology, const Positions& positions,
                      const std::vector<bool>& skin, Index count);

/// A match of the relief of a face with a surface.
struct ReliefMatch {
  /// Partial correlation between the depths of the surface and the depths of the mean face, after
  /// an offset, slopes and curvatures are removed from both. 1 for the mean face itself, 0.75 to
  /// 0.97 for faces, rarely above 0.6 for other surfaces.
  double agreement = -1;
  /// The agreement, plus 0.15 if the known eyeballs are at the eyes of this match, or minus 0.15 if
  /// they are elsewhere.
  double votes = -1;
  /// index of the requested axes that are nearest to the face's axes
  std::size_t view = 0;
  double degrees_off = 0;  ///< angle between these requested axes and the axes of the face
  HeadAxes axes;  ///< axes of the face; equal to the requested axes if they differ by less than 5°
  /// Axes in which the face is symmetric and as upright as the mean face. Small angles between
  /// these and the requested axes come from the posture and form of the face; `axes` ignores them.
  HeadAxes frame;
  Eigen::Vector3d between;  ///< point on the surface between the eyes
  double scale = 1;    ///< units of the positions per millimetre of the mean face, horizontally
  double stretch = 1;  ///< vertical scale as a multiple of `scale`
};

/// A match with fewer votes does not count as a face.
inline constexpr double kMinVotes = 0.65;
/// A match whose axes differ by more degrees from the requested axes is rejected.
inline constexpr double kMaxDegreesOff = 45;

/// Searches a surface for the relief of a face (nose, eye sockets, mouth and chin) by normalised
/// cross-correlation with the depths of a mean face. Finds faces of any size that are rotated by up
/// to about 35° from one of `axes` in any direction. Searches for rotated faces only if no upright
/// face matches.
/// \param samples  see sample_skin
/// \param eyes     centres of the eyeballs if known; they vote for or against a match
/// \return the match with the most votes, even if they are few; nothing if there are no samples
std::optional<ReliefMatch> match_relief(const Positions& samples, const std::vector<HeadAxes>& axes,
                                        const std::vector<Eigen::Vector3d>& eyes);

}  // namespace crowdface
