// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/heads/head_file.h"
#include "crowdface/mesh/colour_rows.h"

namespace crowdface {

/// Replaces the mesh of `head` by the mesh of `mesh_source`. Both heads have the same vertices in
/// the same order. The positions of `head` stay.
/// \param colours  vertex colours of `head`
void replace_mesh(HeadFile& head, const HeadFile& mesh_source, const ColourRows& colours = {});

/// Matches the vertices of two meshes that have the same polygons in the same order, although an
/// export may have numbered the vertices anew, split vertices at seams or joined vertices that have
/// the same position.
/// \param found_positions  positions of `found`
/// \return for each vertex of `expected`, the matching vertex of `found`. Nothing if the corners of
///         an expected vertex have several positions, or if the meshes differ otherwise.
std::optional<std::vector<std::uint32_t>> match_vertices_by_corners(
    const Topology& expected, const Topology& found, const Positions& found_positions);

/// Converts all heads to a common mesh if their meshes differ only in the way they were exported.
/// An export may change the order of vertices and polygons, triangulate polygons, split vertices at
/// seams, and join vertices at the same position. The common mesh is the mesh of most heads; its
/// vertices at seams are joined if any head joins them. Logs each change.
void convert_to_common_mesh(std::vector<HeadFile>& heads);

}  // namespace crowdface
