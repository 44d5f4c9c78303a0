// SPDX-License-Identifier: Apache-2.0
#include "crowdface/neck/neck_bend.h"

#include <algorithm>
#include <span>

#include <Eigen/SparseCholesky>

#include "crowdface/core/error.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/edge_distances.h"
#include "crowdface/mesh/triangles.h"
#include "crowdface/wrap/elastic_solve.h"

namespace crowdface {
namespace {

/// The triangles of all polygons with a corner that is a moved vertex or a neighbour of a moved
/// vertex. The Laplacians of the moved vertices and their neighbours depend on no other triangles.
std::vector<Triangle> triangles_around(const Topology& topology, const Adjacency& adjacency,
                                       std::span<const std::uint32_t> moved) {
  std::vector<bool> touched(static_cast<std::size_t>(topology.vertex_count), false);
  for (const std::uint32_t v : moved) {
    touched[v] = true;
    for (const std::uint32_t other : adjacency.items_of(v)) touched[other] = true;
  }
  std::vector<Triangle> triangles;
  for (const Triangle& triangle : triangles_of(topology)) {
    if (std::ranges::any_of(triangle, [&](std::uint32_t v) { return touched[v]; })) {
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

}  // namespace

struct NeckBend::Factorisation {
  /// #moved by #rim: block of the bending energy's matrix that couples moved vertices with the rim
  SparseMatrix rim_block;
  Eigen::SimplicialLDLT<SparseMatrix> inner;
};

NeckBend::NeckBend(const Topology& topology, const Adjacency& adjacency, const Positions& positions,
                   const Rim& rim, double falloff) {
  EdgeDistances distances(adjacency, positions);
  distances.search(rim, falloff);
  std::vector<std::uint32_t> moved = distances.reached();
  std::vector<Triangle> triangles = triangles_around(topology, adjacency, moved);
  // Give local indices to the vertices that take part: first to the moved vertices in ascending
  // order, then to the rim, then to the fixed vertices. number[v] is the local index of vertex v of
  // the mesh, or kUnnumbered.
  constexpr std::uint32_t kUnnumbered = kNoIndex;
  std::vector<std::uint32_t> number(static_cast<std::size_t>(positions.rows()), kUnnumbered);
  std::vector<std::uint32_t> local;
  const auto add = [&](std::uint32_t v) {
    if (number[v] != kUnnumbered) return;
    number[v] = static_cast<std::uint32_t>(local.size());
    local.push_back(v);
  };
  std::ranges::sort(moved);
  std::vector<bool> is_rim(number.size(), false);
  for (const std::uint32_t v : rim) is_rim[v] = true;
  for (const std::uint32_t v : moved) {
    if (!is_rim[v]) add(v);
  }
  vertices_ = local;
  std::ranges::for_each(rim, add);
  for (Triangle& triangle : triangles) {
    for (std::uint32_t& v : triangle) {
      add(v);
      v = number[v];
    }
  }
  const Positions own = positions(local, kAllColumns);
  const SparseMatrix energy = bending_energy(
      laplacian(triangles, own), vertex_areas(triangles, own), Eigen::VectorXd::Ones(own.rows()));
  const auto inner = static_cast<Index>(vertices_.size());
  auto factorisation = std::make_unique<Factorisation>();
  factorisation->rim_block = energy.block(0, inner, inner, static_cast<Index>(rim.size()));
  factorisation->inner.compute(energy.topLeftCorner(inner, inner));
  if (factorisation->inner.info() != Eigen::Success) {
    throw Error(ExitCode::kBug, "the bending energy of the neck cannot be factorised");
  }
  factorisation_ = std::move(factorisation);
}

NeckBend::~NeckBend() = default;
NeckBend::NeckBend(NeckBend&&) noexcept = default;

Positions NeckBend::bend(const Positions& rim_moves) const {
  if (vertices_.empty()) return Positions(0, 3);
  const Eigen::MatrixXd right = -(factorisation_->rim_block * rim_moves);
  return factorisation_->inner.solve(right);
}

}  // namespace crowdface
