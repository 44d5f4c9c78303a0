// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "crowdface/mesh/triangles.h"
#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// A triangle and a growing number of rings of vertices around it.
class GrowingPatch {
 public:
  GrowingPatch(const SkinMesh& skin, const Triangle& triangle);

  /// Adds the next ring of vertices.
  void grow();
  /// The patch's vertices, as vertex indices of the skin.
  std::span<const std::uint32_t> vertices() const { return vertices_; }
  /// Weight of vertex `i` of the patch: 1 at the triangle, falling to 0 beyond the last ring. With
  /// a larger steepness, the weight falls mainly near the border.
  double weight(std::size_t i) const {
    return std::min(1.0, weight_steepness_ * (1 - rings_[i] / (ring_count_ + 1.0)));
  }
  /// Sets the steepness that `weight` uses.
  void set_weight_steepness(double weight_steepness) { weight_steepness_ = weight_steepness; }

 private:
  const SkinMesh& skin_;
  std::vector<std::uint32_t> vertices_;  ///< the patch's vertices, as vertex indices of the skin
  std::vector<int> rings_;  ///< for each of the `vertices_`, its ring; 0: a corner of the triangle
  std::vector<bool> is_member_;  ///< for each vertex of the skin, whether the patch contains it
  int ring_count_ = 0;           ///< number of rings added so far
  double weight_steepness_ = 1;  ///< see `weight`
};

/// An operation on a patch (`make`), and the operation that reverts it (`undo`).
struct PatchChange {
  std::function<void(const GrowingPatch&)> make, undo;
};

/// Repairs triangles of a skin by operations on patches around them.
class PatchMender {
 public:
  /// \param rest_positions  #skin by 3, in millimetres: a patch grows to at most twelve rings of
  /// vertices or to about 15 mm, measured in these positions.
  PatchMender(const SkinMesh& skin, const Positions& rest_positions);

  /// For each bad triangle, finds the smallest surrounding patch on which `change` reduces the
  /// number of bad triangles, and applies `change` there. If there is no such patch, the triangle
  /// stays unchanged.
  /// \param triangles  indices of the triangles that may be bad.
  /// \param is_bad  whether a triangle needs repair.
  void mend(std::span<const std::uint32_t> triangles,
            const std::function<bool(const Triangle&)>& is_bad, const PatchChange& change) const;

 private:
  /// Repairs one triangle as described for `mend`.
  void mend_around(const Triangle& triangle, const std::function<bool(const Triangle&)>& is_bad,
                   const PatchChange& change) const;

  const SkinMesh& skin_;
  /// For each vertex of the skin, the triangles around the vertex.
  VertexFaces triangles_of_vertex_;
  int max_rings_ = 0;  ///< maximum number of rings in a patch, around the triangle to repair
};

}  // namespace crowdface
