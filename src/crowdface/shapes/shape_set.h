// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "crowdface/mesh/displacements.h"

namespace crowdface {

/// A facial expression (blend shape): a name, and the displacements to add to a mesh at rest.
struct Shape {
  std::string name;
  Displacements moves;
};

/// One head's own version of an expression.
struct OwnShape {
  std::vector<std::uint32_t> vertices;  ///< indices of the moved vertices, ascending
  FloatPositions moves;                 ///< displacements of `vertices`, #vertices by 3
};

/// Expressions in the topology of a crowd's heads: one set for a template, or one set for each
/// head.
struct ShapeSet {
  /// #V by 3: the mesh at rest, which is the template or the mean head; no rows if there are no
  /// shapes
  Positions neutral;
  std::vector<Shape> shapes;  ///< the template's shapes, or the means of the heads' shapes
  /// #heads by #shapes: each head's own shapes; empty if all heads use one set
  std::vector<std::vector<OwnShape>> head_shapes = {};
};

/// Returns the memory, in bytes, of one face's displacements for all shapes.
std::size_t displacement_bytes(const ShapeSet& shapes);
/// Returns the memory, in bytes, of ShapeSet::head_shapes: of the heads' own shapes.
std::size_t own_shape_bytes(const ShapeSet& shapes);

/// Computes a blend shape from a mesh with this expression and the mesh at rest. Vertices that move
/// by at most 10⁻⁵ · `extent` (0.004 mm on a head) do not belong to the shape.
///
/// \param extent  Diagonal of the skin's bounding box.
Shape make_shape(std::string name, const Positions& neutral, const Positions& mesh, double extent);

/// Stores the displacements of one head's own version of an expression in single precision.
OwnShape make_own_shape(const Displacements& moves);
/// Inverse of make_own_shape.
Displacements displacements_of(const OwnShape& shape);

/// Returns the mean, over all heads, of one shape's displacements. The result contains every vertex
/// that the shape moves on at least one head.
Displacements mean_displacements(const std::vector<std::vector<OwnShape>>& head_shapes,
                                 std::size_t shape);

/// The weight of one set of shapes in a blend of several sets.
struct ShapeSetShare {
  std::uint32_t set;    ///< index of the set of shapes (the head that has these shapes)
  double blend_weight;  ///< weight of this set, 0 to 1
};
using ShapeSetShares = std::vector<ShapeSetShare>;

/// For each region, the weights of the sets of shapes that are blended there. The weights of a
/// region sum to one.
using RegionShares = std::vector<ShapeSetShares>;

/// Returns the weights of the sets of shapes at a position that belongs to several regions.
///
/// \param alpha  Weight of each region at the position; the weights sum to one.
inline ShapeSetShares shape_set_weights_at(std::span<const double> alpha,
                                           const RegionShares& region_shares) {
  ShapeSetShares shares;
  for (std::size_t k = 0; k < region_shares.size(); ++k) {
    if (alpha[k] == 0) continue;
    for (const ShapeSetShare& of_set : region_shares[k]) {
      shares.push_back({of_set.set, alpha[k] * of_set.blend_weight});
    }
  }
  return shares;
}

}  // namespace crowdface
