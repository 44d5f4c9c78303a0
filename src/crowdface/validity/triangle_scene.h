// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// Two triangles by their numbers, the smaller first.
using TrianglePair = std::pair<std::uint32_t, std::uint32_t>;

/// Triangles in a tree of boxes (Embree's), to be asked which are near each other and what a ray
/// meets. Embree only finds the boxes; triangles are tested here in double precision, so that the
/// answers are the same whatever the processor.
class TriangleScene {
 public:
  /// \param triangles, positions  must outlive the scene.
  /// \param margin  by which boxes are grown on all sides.
  /// \throws IoError if there is too little memory.
  TriangleScene(const std::vector<Triangle>& triangles, const Positions& positions, double margin);
  ~TriangleScene();
  TriangleScene(const TriangleScene&) = delete;
  TriangleScene& operator=(const TriangleScene&) = delete;

  /// Pairs without a common vertex whose boxes overlap, ascending. Triangles at a vertex of more than a
  /// thousand are left out.
  std::vector<TrianglePair> near_pairs() const;

  /// Whether a ray meets a triangle other than the one it starts from.
  /// \param direction  of any length but zero.
  bool meets(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
             std::uint32_t start) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace crowdface
