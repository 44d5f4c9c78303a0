// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "crowdface/io/glb_options.h"
#include "crowdface/mesh/displacements.h"

namespace crowdface {

/// A morph target in files whose vertices are split at seams.
struct GlbTargetRows {
  std::vector<std::uint32_t> rows;      ///< of the target's moves, one after the other
  std::vector<std::uint32_t> vertices;  ///< #rows, of the file, ascending
  bool whole = false;                   ///< it moves every vertex of the mesh
};

/// \param split  the original vertex of each of the file
/// \param count  of the original vertices
GlbTargetRows target_rows(const GlbTarget& target, std::span<const std::uint32_t> split,
                          Index count);

/// The least and largest moves of a target; zero is among them unless it is whole.
std::pair<Eigen::RowVector3d, Eigen::RowVector3d> target_bounds(const Displacements& moves,
                                                                bool whole);

}  // namespace crowdface
