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

/// Converts sRGB colours from fractions (0 to 1) to bytes.
ColourRows byte_colours(const ColourValues& fractions);
/// Converts sRGB colours from bytes to fractions (0 to 1).
ColourValues colour_fractions(const ColourRows& colours);

/// If no colour value of a mesh exceeds this number, the values are fractions, and values above 1
/// are clamped to 1; otherwise they are bytes from 0 to 255.
inline constexpr double kLargestFraction = 2;

/// The colours of the `v` lines. Vertices without a colour are white; no rows if fewer than half of
/// the vertices have a colour.
/// \param vertices  number of vertices in the text.
ColourRows obj_colours(std::string_view text, Eigen::Index vertices);

/// Returns the text with a colour after the coordinates of each `v` line, and without the `#MRGB`
/// lines.
std::string with_colours(std::string_view text, const ColourRows& colours);

/// Moves the colours of `#MRGB` lines to the `v` lines. If a file has several subtools (ZBrush's
/// parts of a model), each subtool has its own colours; a subtool without colours becomes white.
/// \return the new text; nothing if the number of `#MRGB` colours differs from the number of
/// vertices, or if fewer than half of the vertices have a colour.
std::optional<std::string> move_polypaint_to_vertices(std::string_view text);

}  // namespace crowdface
