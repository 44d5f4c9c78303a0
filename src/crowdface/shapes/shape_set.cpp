// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/shape_set.h"

#include <utility>

#include "crowdface/mesh/vector3.h"

namespace crowdface {

Shape shape_of(std::string name, const Positions& neutral, const Positions& mesh, double extent) {
  constexpr double kStill = 1e-5;
  Shape shape{std::move(name), {}};
  std::vector<Eigen::Vector3d> moves;
  for (Index v = 0; v < neutral.rows(); ++v) {
    const Eigen::Vector3d move = row3(mesh, v) - row3(neutral, v);
    if (!(length3(move) > kStill * extent)) continue;
    shape.moves.vertices.push_back(static_cast<std::uint32_t>(v));
    moves.push_back(move);
  }
  shape.moves.moves.resize(static_cast<Index>(moves.size()), 3);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    shape.moves.moves.row(static_cast<Index>(i)) = moves[i].transpose();
  }
  return shape;
}

std::size_t displacement_bytes(const ShapeSet& shapes) {
  std::size_t vertices = 0;
  for (const Shape& shape : shapes.shapes) vertices += shape.moves.vertices.size();
  return vertices * (3 * sizeof(double) + sizeof(std::uint32_t));
}

}  // namespace crowdface
