// SPDX-License-Identifier: Apache-2.0
#include "multiscale_faces/harmonic_map.h"

#include <algorithm>
#include <map>
#include <utility>

#include <Eigen/SparseCholesky>

#include "crowdface/core/error.h"

namespace crowdface::multiscale {
namespace {

/// Smallest weight of an edge. The weight is half the sum of the cotangents opposite to the edge;
/// smaller weights are raised to this value.
constexpr double kSmallestWeight = 1e-3;

std::map<std::pair<std::uint32_t, std::uint32_t>, double> edge_weights(
    const std::vector<Triangle>& triangles, const Positions& positions) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> weights;
  for (const Triangle& t : triangles) {
    const double twice_area = area_vector(positions, t).norm();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[(i + 1) % 3], b = t[(i + 2) % 3];
      const Eigen::RowVector3d to_a = positions.row(a) - positions.row(t[i]);
      const Eigen::RowVector3d to_b = positions.row(b) - positions.row(t[i]);
      const double cotangent = twice_area > 0 ? to_a.dot(to_b) / twice_area : 0;
      weights[std::minmax(a, b)] += cotangent / 2;
    }
  }
  for (auto& [edge, weight] : weights) weight = std::clamp(weight, kSmallestWeight, 1e3);
  return weights;
}

/// Places the border on the sides of the square.
void place_border(const FrontPatch& patch, const Positions& positions, TextureCoordinates& uvs) {
  const std::vector<std::uint32_t>& border = patch.border;
  const std::array<Eigen::RowVector2d, 5> square = {
      Eigen::RowVector2d(0, 0), {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (std::size_t side = 0; side < 4; ++side) {
    const std::size_t begin = patch.corners_in_border[side];
    const std::size_t count =
        (patch.corners_in_border[(side + 1) % 4] + border.size() - begin - 1) % border.size() + 1;
    std::vector<double> length = {0};
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t a = border[(begin + i) % border.size()],
                          b = border[(begin + i + 1) % border.size()];
      length.push_back(length.back() + (positions.row(a) - positions.row(b)).norm());
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double share = length[i] / length.back();
      uvs.row(border[(begin + i) % border.size()]) =
          (1 - share) * square[side] + share * square[side + 1];
    }
  }
}

}  // namespace

TextureCoordinates harmonic_map(const FrontPatch& patch, const Positions& positions) {
  TextureCoordinates uvs = TextureCoordinates::Zero(patch.vertex_count(), 2);
  place_border(patch, positions, uvs);

  // The unknowns are the vertices that are not on the border.
  std::vector<Index> unknown(static_cast<std::size_t>(patch.vertex_count()), 0);
  for (const std::uint32_t v : patch.border) unknown[v] = -1;
  Index count = 0;
  for (Index& row : unknown) {
    if (row == 0) row = count++;
  }
  std::vector<Eigen::Triplet<double>> entries;
  TextureCoordinates right = TextureCoordinates::Zero(count, 2);
  for (const auto& [edge, weight] : edge_weights(patch.triangles, positions)) {
    for (const auto& [v, neighbour] : {edge, std::pair(edge.second, edge.first)}) {
      if (unknown[v] < 0) continue;
      entries.emplace_back(unknown[v], unknown[v], weight);
      if (unknown[neighbour] < 0) {
        right.row(unknown[v]) += weight * uvs.row(neighbour);
      } else {
        entries.emplace_back(unknown[v], unknown[neighbour], -weight);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success) {
    throw InvalidInput("the front of the head cannot be laid out on a square");
  }
  const Eigen::MatrixXd inside = factors.solve(Eigen::MatrixXd(right));
  for (std::size_t v = 0; v < unknown.size(); ++v) {
    if (unknown[v] >= 0) uvs.row(static_cast<Index>(v)) = inside.row(unknown[v]);
  }
  return uvs;
}

}  // namespace crowdface::multiscale
