// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "crowdface/mesh/displacements.h"

namespace crowdface {

/// One expression, as displacements of the template's neutral mesh.
struct Shape {
  std::string name;
  Displacements moves;
};

/// The expressions of a template, in the topology of a crowd's heads.
struct ShapeSet {
  Positions neutral;  ///< #V by 3; of no rows: there are no shapes
  std::vector<Shape> shapes;
};

/// What the displacements of all shapes of one face take.
std::size_t displacement_bytes(const ShapeSet& shapes);

/// A shape from its mesh. What moves by less than four thousandths of a millimetre on a head (a
/// share of `extent`, the diagonal of the skin's box) stays.
Shape shape_of(std::string name, const Positions& neutral, const Positions& mesh, double extent);

}  // namespace crowdface
