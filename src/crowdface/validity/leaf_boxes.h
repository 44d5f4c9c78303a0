// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// In single precision, and never smaller than in double.
struct Box {
  std::array<float, 3> low, high;
};

bool overlap(const Box& a, const Box& b);

/// Up to eight triangles that lie near each other, side by side for the processor; where there are fewer, the first
/// stands again.
struct LeafCorners {
  static constexpr std::size_t kCount = 8;
  std::array<std::array<std::int32_t, kCount>, 3> vertex;
  std::size_t count;

  /// \param numbers  of the triangles, one to kCount
  LeafCorners(std::span<const std::uint32_t> numbers, std::span<const Triangle> triangles);
};

/// Boxes of the triangles of a leaf; where there are fewer than eight, boxes that overlap nothing.
struct LeafBoxes {
  static constexpr std::size_t kCount = LeafCorners::kCount;
  std::array<std::array<float, kCount>, 3> low, high;

  LeafBoxes() = default;
  /// \param points  #V by 3
  /// \param margin  by which boxes are grown on all sides
  LeafBoxes(const LeafCorners& corners, const SingleRows& points, double margin);
  /// Around all of them.
  Box whole() const;
};

/// Unit normals of the triangles of a leaf.
struct LeafNormals {
  std::array<std::array<float, LeafCorners::kCount>, 3> along;

  LeafNormals() = default;
  LeafNormals(const LeafCorners& corners, const SingleRows& points);
};

/// A ray as boxes are asked about it.
struct BoxRay {
  /// What rounding may take off a distance along it.
  static constexpr double kRounding = 1 + 4 * std::numeric_limits<double>::epsilon();

  std::array<double, 3> origin, inverse;  ///< one through each coordinate of the direction

  BoxRay(const Eigen::Vector3d& from, const Eigen::Vector3d& direction);
};

/// Whether the ray meets it; never without one that it passes through.
/// Slabs, Kay & Kajiya 1986.
bool meets(const BoxRay& ray, const Box& box);
/// The same of the boxes of a leaf: bit i for box i. Those beyond its triangles may be met too.
unsigned met(const BoxRay& ray, const LeafBoxes& boxes);

/// Which boxes of two leaves overlap: bit 8 i + j for box i of the first and box j of the second.
std::uint64_t overlapping(const LeafBoxes& a, const LeafBoxes& b);
/// Which triangles of two leaves have a vertex in common, as bits like these.
std::uint64_t sharing_vertices(const LeafCorners& a, const LeafCorners& b);
/// Which triangles of two leaves face alike: those whose normals' cosine is above `least`, as bits like these.
std::uint64_t facing_alike(const LeafNormals& a, const LeafNormals& b, float least);

}  // namespace crowdface
