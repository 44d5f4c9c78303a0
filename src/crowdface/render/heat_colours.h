// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/render/rgb8_image.h"
#include "crowdface/render/vertex_colours.h"

namespace crowdface {

/// Colour on a scale from blue over green and yellow to red; yellow is lightest.
/// \param scale_position  position on the scale, clamped to [0, 1]. \return  sRGB, each in [0, 1].
Eigen::Vector3f heat_colour(double scale_position);

/// Vertex colours of a heat map: the heat_colour of each vertex's distance.
/// \param distances_mm  #V distances. \param max_mm  the distance that gets the colour red.
VertexColours heat_colours(const Eigen::Ref<const Eigen::VectorXd>& distances_mm, double max_mm);

/// Four to six round numbers, starting with 0, to label a scale from 0 to `max_value`. Requires
/// max_value > 0.
std::vector<double> scale_ticks(double max_value);

/// Draws a colour scale: a bar with numbers below and the title on the left.
/// \throws MissingInput if the font is not installed.
Rgb8Image heat_scale(double max_mm, const std::string& title, int width_px, int height_px,
                     std::array<std::uint8_t, 3> background);

}  // namespace crowdface
