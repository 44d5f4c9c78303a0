// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "crowdface/mesh/displacements.h"

namespace crowdface {

/// One expression, as displacements of a mesh at rest.
struct Shape {
  std::string name;
  Displacements moves;
};

/// Where an expression takes one of the heads.
struct OwnShape {
  std::vector<std::uint32_t> vertices;  ///< ascending
  SingleRows moves;                     ///< #vertices by 3
};

/// Expressions in the topology of a crowd's heads: those of one template, or of each head.
struct ShapeSet {
  Positions
      neutral;  ///< of the template, or the mean head; #V by 3; of no rows: there are no shapes
  std::vector<Shape> shapes;                        ///< of the template, or the mean of the heads'
  std::vector<std::vector<OwnShape>> of_head = {};  ///< #heads by #shapes; empty: one set for all
};

/// What the displacements of all shapes of one face take.
std::size_t displacement_bytes(const ShapeSet& shapes);
/// What a set for each head takes.
std::size_t own_shape_bytes(const ShapeSet& shapes);

/// A shape from its mesh. What moves by less than four thousandths of a millimetre on a head (a
/// share of `extent`, the diagonal of the skin's box) stays.
Shape shape_of(std::string name, const Positions& neutral, const Positions& mesh, double extent);

OwnShape own_shape_of(const Displacements& moves);
Displacements displacements_of(const OwnShape& shape);

/// The mean of all heads' displacements: of the vertices that one of them moves.
Displacements mean_of(const std::vector<std::vector<OwnShape>>& of_head, std::size_t shape);

/// How much one of several sets of shapes counts.
struct SetShare {
  std::uint32_t set;
  double share;
};
using SetShares = std::vector<SetShare>;

/// The sets whose shape a face has, region by region; those of a region add up to one.
using RegionShares = std::vector<SetShares>;

/// At a place that belongs to several regions.
/// \param alpha  #regions, of sum one
inline SetShares shares_at(std::span<const double> alpha, const RegionShares& of_region) {
  SetShares shares;
  for (std::size_t k = 0; k < of_region.size(); ++k) {
    if (alpha[k] == 0) continue;
    for (const SetShare& of_set : of_region[k]) {
      shares.push_back({of_set.set, alpha[k] * of_set.share});
    }
  }
  return shares;
}

}  // namespace crowdface
