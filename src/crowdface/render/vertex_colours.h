// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace crowdface {

/// #V by 3 colours as a screen shows them (sRGB), each in [0, 1].
using VertexColours = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The k-th of a row of colours that are easy to tell apart, over and over.
Eigen::Vector3f palette_colour(Eigen::Index k);

/// Each region in its own colour, mixed where regions overlap.
/// \param alpha  #V by #R shares of the regions, rows summing to one.
VertexColours region_colours(const Eigen::Ref<const Eigen::MatrixXd>& alpha);

/// One region's mask: its colour where it is 1, pale clay where it is 0.
/// \param mask  #V, in [0, 1].
VertexColours mask_colours(const Eigen::Ref<const Eigen::VectorXd>& mask,
                           const Eigen::Vector3f& colour);

}  // namespace crowdface
