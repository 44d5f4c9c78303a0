// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "crowdface/core/units.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/render/surface_kind.h"

namespace crowdface {

/// #V by 3 colours as a screen shows them (sRGB), each in [0, 1].
using VertexColours = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The k-th of a row of colours that are easy to tell apart, over and over.
Eigen::Vector3f palette_colour(Eigen::Index k);

/// Each region in its own colour, mixed where regions overlap.
/// \param alpha    #V by #R shares of the regions, rows summing to one.
/// \param colours  #R by 3
VertexColours region_colours(const Eigen::Ref<const Eigen::MatrixXd>& alpha,
                             const VertexColours& colours);

/// The colours that a render gives the surfaces themselves, irises painted where the eyes look.
/// \param front  where the face looks.
VertexColours surface_colours(const Topology& topology, const Surfaces& surfaces,
                              const Positions& positions, Axis front);

/// #V by 3: where a vertex of an eyeball lies as seen from where the eye looks, in radii of the
/// eyeball: across, along and ahead of its middle. They are linear in the position, so that an iris
/// painted by them is round on the coarsest mesh.
using EyeCoordinates = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
inline constexpr float kNoEye = -2;  ///< stands in the last column of all other vertices

/// \return nothing if there are no eyeballs, or they all have paints of their own.
std::optional<EyeCoordinates> eye_coordinates(const Topology& topology, const Surfaces& surfaces,
                                              const Positions& positions, Axis front);

/// One region's mask: its colour where it is 1, pale clay where it is 0.
/// \param mask  #V, in [0, 1].
VertexColours mask_colours(const Eigen::Ref<const Eigen::VectorXd>& mask,
                           const Eigen::Vector3f& colour);

}  // namespace crowdface
