// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/seam.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/mesh/all_columns.h"

namespace crowdface {
namespace {

/// Adds displacements to `sum`. Skips vertices that have no entry in `sum`.
/// \param vertices  ascending.
/// \param rows  the displacement of each vertex in `vertices`.
void add_rows(const std::vector<std::uint32_t>& vertices, const Positions& rows,
              Displacements& sum) {
  auto at = sum.vertices.begin();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    at = std::lower_bound(at, sum.vertices.end(), vertices[i]);
    if (at == sum.vertices.end()) return;
    if (*at == vertices[i])
      sum.moves.row(at - sum.vertices.begin()) += rows.row(static_cast<Index>(i));
  }
}

void set_rows(const Rim& rim, const Positions& rows, Positions& mesh) {
  for (std::size_t i = 0; i < rim.size(); ++i) mesh.row(rim[i]) = rows.row(static_cast<Index>(i));
}

/// Bends the neck of a mesh so that the rim gets the positions `goal`.
void bend_to(const Seam& seam, const Positions& goal, Positions& mesh) {
  const Positions moves = goal - mesh(seam.rim, kAllColumns);
  // A rim counts as already in place if no coordinate differs from the goal by more than kRounding
  // times the largest absolute coordinate of the goal. If all heads end in the same ring, the rim
  // of their blend differs from this ring only by rounding errors.
  constexpr double kRounding = 1e-9;
  if (moves.cwiseAbs().maxCoeff() > kRounding * goal.cwiseAbs().maxCoeff()) {
    const std::vector<std::uint32_t>& bent = seam.neck_bend.vertices();
    const Positions by = seam.neck_bend.bend(moves);
    for (std::size_t i = 0; i < bent.size(); ++i)
      mesh.row(bent[i]) += by.row(static_cast<Index>(i));
  }
  set_rows(seam.rim, goal, mesh);
}

}  // namespace

void Seam::bend_to_seam(Positions& mesh) const {
  bend_to(*this, positions, mesh);
}

void Seam::bend_to_rim_of(const Positions& other, Positions& mesh) const {
  bend_to(*this, other(rim, kAllColumns), mesh);
}

void Seam::keep_rim_still(Displacements& moves) const {
  Positions at_rim = Positions::Zero(positions.rows(), 3);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const auto found = std::ranges::lower_bound(moves.vertices, rim[i]);
    if (found == moves.vertices.end() || *found != rim[i]) continue;
    at_rim.row(static_cast<Index>(i)) = moves.moves.row(found - moves.vertices.begin());
  }
  if (at_rim.isZero(0)) return;
  Displacements held;
  std::ranges::set_union(moves.vertices, neck_bend.vertices(), std::back_inserter(held.vertices));
  std::erase_if(held.vertices, [&](std::uint32_t v) { return contains(rim, v); });
  held.moves = Positions::Zero(static_cast<Index>(held.vertices.size()), 3);
  add_rows(moves.vertices, moves.moves, held);
  add_rows(neck_bend.vertices(), -neck_bend.bend(at_rim), held);
  moves = std::move(held);
}

void Seam::set_normals(Positions& mesh_normals) const {
  if (mesh_normals.rows() > 0) set_rows(rim, normals, mesh_normals);
}

}  // namespace crowdface
