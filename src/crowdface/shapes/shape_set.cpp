// SPDX-License-Identifier: Apache-2.0
#include "crowdface/shapes/shape_set.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {

Shape make_shape(std::string name, const Positions& neutral, const Positions& mesh, double extent) {
  constexpr double kStill = 1e-5;
  Shape shape{std::move(name), {}};
  std::vector<std::uint32_t>& vertices = shape.moves.vertices;
  for (std::uint32_t v = 0; v < neutral.rows(); ++v) {
    if ((row3(mesh, v) - row3(neutral, v)).norm() > kStill * extent) vertices.push_back(v);
  }
  shape.moves.moves = mesh(vertices, kAllColumns) - neutral(vertices, kAllColumns);
  return shape;
}

OwnShape make_own_shape(const Displacements& moves) {
  return {moves.vertices, moves.moves.cast<float>()};
}

Displacements displacements_of(const OwnShape& shape) {
  return {shape.vertices, shape.moves.cast<double>()};
}

Displacements mean_displacements(const std::vector<std::vector<OwnShape>>& head_shapes,
                                 std::size_t shape) {
  Displacements mean;
  for (const auto& shapes : head_shapes) {
    std::vector<std::uint32_t> both;
    std::ranges::set_union(mean.vertices, shapes[shape].vertices, std::back_inserter(both));
    mean.vertices = std::move(both);
  }
  mean.moves = Positions::Zero(static_cast<Index>(mean.vertices.size()), 3);
  for (const auto& shapes : head_shapes) {
    const OwnShape& one = shapes[shape];
    std::size_t row = 0;
    for (std::size_t i = 0; i < one.vertices.size(); ++i) {
      while (mean.vertices[row] != one.vertices[i]) ++row;
      mean.moves.row(static_cast<Index>(row)) +=
          one.moves.row(static_cast<Index>(i)).cast<double>() /
          static_cast<double>(head_shapes.size());
    }
  }
  return mean;
}

std::size_t displacement_bytes(const ShapeSet& shapes) {
  std::size_t vertices = 0;
  for (const Shape& shape : shapes.shapes) vertices += shape.moves.vertices.size();
  return vertices * (3 * sizeof(double) + sizeof(std::uint32_t));
}

std::size_t own_shape_bytes(const ShapeSet& shapes) {
  std::size_t vertices = 0;
  for (const auto& of_head : shapes.head_shapes) {
    for (const OwnShape& shape : of_head) vertices += shape.vertices.size();
  }
  return vertices * (3 * sizeof(float) + sizeof(std::uint32_t));
}

}  // namespace crowdface
