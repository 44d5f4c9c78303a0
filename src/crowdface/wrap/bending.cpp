// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/bending.h"

#include <algorithm>
#include <cmath>

#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr double kLeastCotangent = 0.05;

}  // namespace

Eigen::VectorXd vertex_areas(const std::vector<Triangle>& triangles, const Positions& positions) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(positions.rows());
  double sum = 0;
  for (const Triangle& t : triangles) {
    const double area = length3(area_vector(positions, t)) / 2;
    for (const std::uint32_t v : t) areas(v) += area / 3;
    sum += area;
  }
  constexpr double kLeast = 1e-3;
  const double least = kLeast * sum / static_cast<double>(std::max<Index>(1, positions.rows()));
  for (double& area : areas) area = std::max(area, least);
  return areas;
}

SparseMatrix laplacian(const std::vector<Triangle>& triangles, const Positions& positions) {
  using Entry = Eigen::Triplet<double>;
  std::vector<Entry> entries;
  entries.reserve(12 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<int>(t[(k + 1) % 3]), j = static_cast<int>(t[(k + 2) % 3]);
      const Eigen::Vector3d apex = row3(positions, t[k]);
      const Eigen::Vector3d a = row3(positions, i) - apex, b = row3(positions, j) - apex;
      const double area = length3(cross3(a, b));
      const double cotangent = area > 0 ? std::min(dot3(a, b) / area, 1 / kLeastCotangent) : 0;
      const double weight = std::max(cotangent, kLeastCotangent) / 2;
      entries.insert(entries.end(), {Entry(i, j, weight), Entry(j, i, weight), Entry(i, i, -weight),
                                     Entry(j, j, -weight)});
    }
  }
  SparseMatrix matrix(positions.rows(), positions.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SparseMatrix bending_energy(const SparseMatrix& laplacian, const Eigen::VectorXd& areas,
                            const Eigen::VectorXd& factors) {
  const Eigen::VectorXd weights = factors.cwiseQuotient(areas);
  return laplacian.transpose() * weights.asDiagonal() * laplacian;
}

}  // namespace crowdface
