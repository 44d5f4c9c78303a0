// SPDX-License-Identifier: Apache-2.0
// Colours at vertices in OBJ files: `v x y z r g b`, and ZBrush's comments `#MRGB`.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Converts colours between bytes and sRGB values from 0 to 1.
ColourRows byte_colours(const Positions& shares);
Positions colour_fractions(const ColourRows& colours);

/// The colours of the `v` lines; no rows if any line lacks a colour. Values up to 255 count as
/// bytes.
/// \param vertices  number of vertices in the text.
ColourRows obj_colours(std::string_view text, Eigen::Index vertices);

/// The text with these colours after the coordinates of each `v` line, and without `#MRGB` lines.
std::string with_colours(std::string_view text, const ColourRows& colours);

/// The text with the colours of `#MRGB` lines moved to the `v` lines; nothing unless `#MRGB` gives
/// a colour for every vertex.
std::optional<std::string> move_polypaint_to_vertices(std::string_view text);

}  // namespace crowdface
