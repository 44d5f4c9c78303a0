// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// An axis-aligned box in single precision, rounded outwards: it contains the exact box.
struct Box {
  std::array<float, 3> low, high;
};

/// Whether two boxes overlap.
bool boxes_overlap(const Box& a, const Box& b);

/// Corners of up to eight neighbouring triangles (a leaf) in a layout for SIMD instructions. If the
/// leaf has fewer triangles, copies of the first triangle fill the rest.
struct LeafCorners {
  static constexpr std::size_t kCount = 8;
  std::array<std::array<std::int32_t, kCount>, 3> vertex;  ///< [corner][triangle]
  std::size_t count;                                       ///< number of triangles

  /// \param numbers  indices of the triangles, one to kCount
  LeafCorners(std::span<const std::uint32_t> numbers, std::span<const Triangle> triangles);
};

/// Boxes of the triangles in a leaf. If there are fewer than eight triangles, the remaining boxes
/// overlap nothing.
struct LeafBoxes {
  static constexpr std::size_t kCount = LeafCorners::kCount;
  std::array<std::array<float, kCount>, 3> low, high;

  LeafBoxes() = default;
  /// \param points  #V by 3
  /// \param margin  distance by which the boxes grow on all sides
  LeafBoxes(const LeafCorners& corners, const SingleRows& points, double margin);
  /// Returns the box around all triangles of the leaf.
  Box bounding_box() const;
};

/// Unit normals of the triangles in a leaf.
struct LeafNormals {
  std::array<std::array<float, LeafCorners::kCount>, 3> components;  ///< [axis][triangle]

  LeafNormals() = default;
  LeafNormals(const LeafCorners& corners, const SingleRows& points);
};

/// A ray prepared for intersection tests with boxes.
struct BoxRay {
  /// Upper bound of the relative rounding error of a distance along the ray.
  static constexpr double kRounding = 1 + 4 * std::numeric_limits<double>::epsilon();

  std::array<double, 3> origin, inverse;  ///< inverse: 1 / each coordinate of the direction

  BoxRay(const Eigen::Vector3d& from, const Eigen::Vector3d& direction);
};

/// Whether a ray hits a box (slab method, Kay & Kajiya 1986). Rounding never causes a missed hit.
bool ray_hits_box(const BoxRay& ray, const Box& box);
/// Tests a ray against all boxes of a leaf: bit i is set if the ray hits box i. Bits beyond the
/// leaf's triangles are undefined.
unsigned hit_mask(const BoxRay& ray, const LeafBoxes& boxes);

/// Bit mask of the pairs of overlapping boxes from two leaves: bit 8 i + j belongs to box i of `a`
/// and box j of `b`.
std::uint64_t overlap_mask(const LeafBoxes& a, const LeafBoxes& b);
/// Bit mask of the pairs of triangles with a common vertex, encoded like `overlap_mask`.
std::uint64_t shared_vertex_mask(const LeafCorners& a, const LeafCorners& b);
/// Bit mask of the pairs of triangles whose normals have a cosine above `min_cosine`, encoded like
/// `overlap_mask`.
std::uint64_t similar_normal_mask(const LeafNormals& a, const LeafNormals& b, float min_cosine);

}  // namespace crowdface
