// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// An axis-aligned box in single precision. The coordinates are rounded outwards, so that the box
/// contains the exact box.
struct Box {
  std::array<float, 3> low, high;  ///< smallest and largest coordinates
};

/// Returns whether two boxes overlap.
bool boxes_overlap(const Box& a, const Box& b);

/// The corners of the triangles in a leaf (up to eight neighbouring triangles), in a layout for
/// SIMD instructions. If the leaf has fewer than eight triangles, copies of the first triangle fill
/// the other places.
struct LeafCorners {
  static constexpr std::size_t kMaxTriangles = 8;
  /// vertex indices, as [corner][triangle]
  std::array<std::array<std::int32_t, kMaxTriangles>, 3> vertex;
  std::size_t count;  ///< number of triangles in the leaf

  /// \param triangle_indices  indices of the leaf's triangles, one to kMaxTriangles
  LeafCorners(std::span<const std::uint32_t> triangle_indices, std::span<const Triangle> triangles);
};

/// The bounding boxes of the triangles in a leaf. If there are fewer than eight triangles, the
/// other boxes are empty and overlap no box.
struct LeafBoxes {
  static constexpr std::size_t kMaxTriangles = LeafCorners::kMaxTriangles;
  /// smallest and largest coordinates of each box, as [axis][triangle]
  std::array<std::array<float, kMaxTriangles>, 3> low, high;

  LeafBoxes() = default;
  /// \param points  positions of the vertices, #V by 3
  /// \param margin  distance by which the boxes grow on all sides
  LeafBoxes(const LeafCorners& corners, const FloatPositions& points, double margin);
  /// Returns the box that contains all triangles of the leaf.
  Box bounding_box() const;
};

/// Unit normals of the triangles in a leaf.
struct LeafNormals {
  /// coordinates of the normals, as [axis][triangle]
  std::array<std::array<float, LeafCorners::kMaxTriangles>, 3> components;

  LeafNormals() = default;
  LeafNormals(const LeafCorners& corners, const FloatPositions& points);
};

/// A ray with precomputed values for intersection tests with boxes.
struct BoxRay {
  /// Factor that is larger than 1 by at least the relative rounding error of a distance along the
  /// ray.
  static constexpr double kRounding = 1 + 4 * std::numeric_limits<double>::epsilon();

  /// `inverse_direction` contains 1/d for each coordinate d of the direction
  std::array<double, 3> origin, inverse_direction;

  BoxRay(const Eigen::Vector3d& from, const Eigen::Vector3d& direction);
};

/// Returns whether a ray hits a box (slab method, Kay & Kajiya 1986). Despite rounding, no hit is
/// missed.
bool ray_hits_box(const BoxRay& ray, const Box& box);
/// Tests a ray against all boxes of a leaf. Bit i of the result is set if the ray hits box i. If
/// the leaf has fewer than eight triangles, the other bits are undefined.
unsigned hit_mask(const BoxRay& ray, const LeafBoxes& boxes);

/// Returns which boxes of two leaves overlap, as a bit mask. Bit number 8·i + j is set if box i of
/// `a` overlaps box j of `b`.
std::uint64_t overlap_mask(const LeafBoxes& a, const LeafBoxes& b);
/// Returns a bit mask over pairs of triangles, with the bit order of `overlap_mask`: bit 8·i + j is
/// set if triangle i of `a` and triangle j of `b` have a vertex in common.
std::uint64_t shared_vertex_mask(const LeafCorners& a, const LeafCorners& b);
/// Returns a bit mask over pairs of triangles, with the bit order of `overlap_mask`: bit 8·i + j is
/// set if triangle i of `a` and triangle j of `b` have similar normals. Two normals are similar if
/// the cosine of their angle is above `min_cosine`.
std::uint64_t similar_normal_mask(const LeafNormals& a, const LeafNormals& b, float min_cosine);

}  // namespace crowdface
