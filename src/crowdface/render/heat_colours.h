// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/render/rgb8_image.h"
#include "crowdface/render/vertex_colours.h"

namespace crowdface {

/// From blue over green and yellow to red, lighter in the middle than at the ends.
/// \param share  0 … 1, beyond that clamped. \return  sRGB, each in [0, 1].
Eigen::Vector3f heat_colour(double share);

/// How far apart points are, as colours. \param mm  #V. \param most_mm  where the scale ends.
VertexColours heat_colours(const Eigen::Ref<const Eigen::VectorXd>& mm, double most_mm);

/// The numbers that stand at a scale from 0: round ones, four to six of them, the last below or at
/// `most` (for most > 0).
std::vector<double> scale_ticks(double most);

/// The scale as a picture: a bar with its numbers under it and the title on its left.
/// \throws MissingInput without the font.
Rgb8Image heat_scale(double most_mm, const std::string& title, int width_px, int height_px,
                     std::array<std::uint8_t, 3> background);

}  // namespace crowdface
