// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/head_axes.h"

namespace crowdface {

/// Number of samples of the skin that suffices to find a face even if the mesh also has shoulders
/// and chest.
inline constexpr Index kSkinSamples = 150'000;

/// Samples the skin evenly by area, so that measurements on the samples do not depend on the
/// tessellation of the mesh.
/// \param skin  #V: which vertices are skin; a polygon counts as skin if its first vertex does
/// \return #S by 3, at most `count` rows; empty if the skin has no area
Positions sample_skin(const Topology& topology, const Positions& positions,
                      const std::vector<bool>& skin, Index count);

/// Position, size and orientation of a face found on a surface, and how well its relief matches the
/// mean face.
struct ReliefMatch {
  /// Partial correlation between the depths of the surface and the depths of the mean face, after
  /// an offset, slopes and curvatures are fitted to both depths and subtracted. 1 for the mean face
  /// itself, 0.75 to 0.97 for faces, rarely above 0.6 for other surfaces.
  double correlation = -1;
  /// The correlation, plus 0.15 if the known eyeballs are at the eyes of this match, or minus 0.15
  /// if the eyeballs are elsewhere.
  double score = -1;
  /// index of the requested orientation (argument `axes` of match_relief) that is nearest to the
  /// orientation of the face
  std::size_t nearest_orientation_index = 0;
  /// angle between the nearest requested axes and `fitted_axes`
  double rotation_degrees = 0;
  /// `fitted_axes`, corrected towards the nearest requested axes. If `fitted_axes` are pitched by
  /// less than 10° relative to the nearest requested axes, the correction removes this pitch. If
  /// the corrected axes then differ from the nearest requested axes by less than 5°, `axes` equals
  /// the nearest requested axes.
  HeadAxes axes;
  /// The axes in which the face is symmetric and as upright as the mean face. If `fitted_axes`
  /// differ only slightly from the requested axes (argument `axes` of match_relief), the difference
  /// is due to the posture of the head and the shape of the face.
  HeadAxes fitted_axes;
  Eigen::Vector3d eye_midpoint;  ///< point on the surface between the eyes
  /// size of the face along its side axis: length, in the unit of the samples' positions, that
  /// corresponds to 1 mm on the mean face
  double scale = 1;
  double stretch = 1;  ///< vertical scale divided by the horizontal scale
};

/// A match with a lower score does not count as a face.
inline constexpr double kMinScore = 0.65;
/// A match whose axes differ by a larger angle from the requested axes is rejected.
inline constexpr double kMaxRotationDegrees = 45;

/// Searches a surface for the relief of a face (nose, eye sockets, mouth and chin) by normalised
/// cross-correlation with the depths of a mean face. Finds faces of any size that are rotated by up
/// to about 35° from one of `axes` in any direction. First searches along `axes`; only if no face
/// matches, also searches along rotated axes.
/// \param samples  see sample_skin
/// \param eyes     centres of the eyeballs, if known; used in the score of a match
/// \return the match with the highest score, even if this score is low; nothing if there are no
/// samples
std::optional<ReliefMatch> match_relief(const Positions& samples, const std::vector<HeadAxes>& axes,
                                        const std::vector<Eigen::Vector3d>& eyes);

}  // namespace crowdface
