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

/// Vertices around a triangle, ring by ring.
class GrowingPatch {
 public:
  GrowingPatch(const SkinMesh& skin, const Triangle& triangle);

  void grow();
  std::span<const std::uint32_t> vertices() const { return vertices_; }
  /// How much one of them has a say: 1 at the triangle, and nothing beyond the last ring.
  double share(std::size_t i) const {
    return std::min(1.0, steepness_ * (1 - rings_[i] / (ring_ + 1.0)));
  }
  void set_steepness(double steepness) { steepness_ = steepness; }

 private:
  const SkinMesh& skin_;
  std::vector<std::uint32_t> vertices_;
  std::vector<int> rings_;  ///< of each of them
  std::vector<bool> is_in_;
  int ring_ = 0;
  double steepness_ = 1;
};

/// What is done to a patch, and how it is taken back.
struct PatchChange {
  std::function<void(const GrowingPatch&)> make, undo;
};

/// Mends triangles of a skin by changes to patches around them.
class PatchMender {
 public:
  /// \param rest  #skin by 3, in millimetres: patches have up to twelve rings, or reach some 15 mm of it.
  PatchMender(const SkinMesh& skin, const Positions& rest);

  /// Makes a change, around each of some triangles that is bad still, to the smallest patch in which that leaves
  /// fewer bad triangles than there were; none if there is none.
  void mend(std::span<const std::uint32_t> triangles,
            const std::function<bool(const Triangle&)>& is_bad, const PatchChange& change) const;

 private:
  void mend_around(const Triangle& triangle, const std::function<bool(const Triangle&)>& is_bad,
                   const PatchChange& change) const;

  const SkinMesh& skin_;
  FacesAround around_;  ///< of its triangles
  int most_rings_ = 0;
};

}  // namespace crowdface
