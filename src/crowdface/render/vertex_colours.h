// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/render/surface_kind.h"

namespace crowdface {

/// #V by 3 sRGB colours, each in [0, 1].
using VertexColours = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Colour k of a palette of distinct colours; the palette repeats cyclically.
Eigen::Vector3f palette_colour(Eigen::Index k);

/// Vertex colours that show regions: one colour per region, blended by the region weights.
/// \param alpha    #V by #R weights; rows sum to one.
/// \param colours  #R by 3
VertexColours region_colours(const Eigen::Ref<const Eigen::MatrixXd>& alpha,
                             const VertexColours& colours);

/// The vertex colours that FaceRenderer gives surfaces without textures, including painted irises.
/// \param front  direction in which the face looks.
VertexColours surface_colours(const Topology& topology, const Surfaces& surfaces,
                              const Positions& positions, Axis front);

/// #V by 3: position of each eyeball vertex relative to the eyeball's centre, in units of its
/// radius. The first two coordinates are perpendicular to the gaze, the third is along the gaze.
/// The coordinates are linear functions of the position, so that an iris painted from interpolated
/// coordinates is round even on a coarse mesh.
using EyeCoordinates = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// third coordinate of vertices that belong to no eyeball
inline constexpr float kNoEyeballCoordinate = -2;

/// Computes the EyeCoordinates of all vertices.
/// \return nothing if there are no eyeballs, or if all eyeballs have colours of their own.
std::optional<EyeCoordinates> eye_coordinates(const Topology& topology, const Surfaces& surfaces,
                                              const Positions& positions, Axis front);

/// Vertex colours that show a region's mask: `colour` for weight 1, pale clay for weight 0.
/// \param mask  #V, clamped to [0, 1].
VertexColours mask_colours(const Eigen::Ref<const Eigen::VectorXd>& mask,
                           const Eigen::Vector3f& colour);

}  // namespace crowdface
