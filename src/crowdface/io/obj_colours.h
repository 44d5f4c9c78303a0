// SPDX-License-Identifier: Apache-2.0
// Colours at vertices in OBJ files: `v x y z r g b`, and ZBrush's comments `#MRGB`.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "crowdface/mesh/colour_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// From and to shares, sRGB from 0 to 1.
ColourRows byte_colours(const Positions& shares);
Positions colour_shares(const ColourRows& colours);

/// The colours of the `v` lines; no rows if a line has none. Numbers up to 255 are taken for bytes.
/// \param vertices  #V of the text
ColourRows obj_colours(std::string_view text, Eigen::Index vertices);

/// The text with these colours behind the coordinates of its `v` lines, and without `#MRGB`.
std::string with_colours(std::string_view text, const ColourRows& colours);

/// The text with what `#MRGB` says at its `v` lines; nothing if it does not say a colour for each vertex.
std::optional<std::string> polypaint_at_vertices(std::string_view text);

}  // namespace crowdface
