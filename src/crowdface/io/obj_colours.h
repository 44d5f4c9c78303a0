// SPDX-License-Identifier: Apache-2.0
// Vertex colours in OBJ files. There are two notations: `v x y z r g b`, and ZBrush's comments
// `#MRGB`.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// These functions convert sRGB colours from values between 0 and 1 to bytes, and back.
ColourRows byte_colours(const Positions& shares);
Positions colour_fractions(const ColourRows& colours);

/// The colours of the `v` lines; no rows if any line lacks a colour. If values exceed 1, all values
/// count as bytes from 0 to 255.
/// \param vertices  number of vertices in the text.
ColourRows obj_colours(std::string_view text, Eigen::Index vertices);

/// Returns the text with a colour after the coordinates of each `v` line, and without the `#MRGB`
/// lines.
std::string with_colours(std::string_view text, const ColourRows& colours);

/// Returns the text after the colours of `#MRGB` lines are moved to the `v` lines. Returns nothing
/// unless `#MRGB` lines give a colour for every vertex.
std::optional<std::string> move_polypaint_to_vertices(std::string_view text);

}  // namespace crowdface
