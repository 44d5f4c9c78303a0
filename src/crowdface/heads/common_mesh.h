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
/// \return #V, a vertex of `found` for each vertex of `expected`; nothing if the corners of an
///         expected vertex have several positions, or if the meshes differ otherwise.
std::optional<std::vector<std::uint32_t>> match_vertices_by_corners(
    const Topology& expected, const Topology& found, const Positions& found_positions);

/// Gives heads a common mesh if their meshes differ only by their export: in the order of vertices
/// and polygons, by triangulation, by vertices that are split at seams, or by vertices that are
/// joined because they have the same position. The common mesh is the mesh of most heads; its
/// vertices at seams are joined if any head joins them. Logs each change.
void give_common_mesh(std::vector<HeadFile>& heads);

}  // namespace crowdface
