// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/detail.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/parts/vector3.h"
#include "crowdface/wrap/bending.h"
#include "crowdface/wrap/shape_fit.h"

namespace crowdface {
namespace {

constexpr double kLeastCosine = 0.7;  // of the scan's normal with the skin's, so that it is no wall
constexpr double kLeastOpenness = 0.15;
constexpr double kUnasked = 1e-4;  ///< weight of staying where the scan says nothing
constexpr int kSteps = 30;

/// Solves (diag(weights) + stiffness) x = weights · values by conjugate gradients with the diagonal as
/// preconditioner: enough where stiffness reaches over an edge or two.
Eigen::VectorXd smooth_fit(const SparseMatrix& stiffness, const Eigen::VectorXd& weights,
                           const Eigen::VectorXd& values) {
  const Eigen::Index count = values.size();
  constexpr std::ptrdiff_t kBlock = 8192;
  const auto product = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return parallel_sum(count, kBlock, [&](auto begin, auto end) {
      double sum = 0;
      for (auto i = begin; i < end; ++i) sum += a(i) * b(i);
      return sum;
    });
  };
  const auto times = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd y(count);
    parallel_blocks(count, kBlock, [&](auto begin, auto end) {
      for (auto i = begin; i < end; ++i) {
        double sum = weights(i) * x(i);
        for (SparseMatrix::InnerIterator entry(stiffness, i); entry; ++entry) {
          sum += entry.value() * x(entry.row());
        }
        y(i) = sum;
      }
    });
    return y;
  };
  const Eigen::VectorXd scale = (weights + stiffness.diagonal()).cwiseInverse();
  Eigen::VectorXd x = values.cwiseProduct(weights).cwiseProduct(scale);
  Eigen::VectorXd residual = weights.cwiseProduct(values) - times(x);
  Eigen::VectorXd direction = scale.cwiseProduct(residual);
  double rho = product(residual, direction);
  const double enough = 1e-10 * rho;
  for (int k = 0; k < kSteps && rho > enough; ++k) {
    const Eigen::VectorXd image = times(direction);
    const double length = rho / product(direction, image);
    x += length * direction;
    residual -= length * image;
    const Eigen::VectorXd scaled = scale.cwiseProduct(residual);
    const double next = product(residual, scaled);
    direction = scaled + (next / rho) * direction;
    rho = next;
  }
  return x;
}

}  // namespace

Positions follow_detail(const SkinMesh& skin, const Positions& positions, const ScanSurface& scan,
                        const DetailOptions& options) {
  const Eigen::VectorXd areas = vertex_areas(skin.triangles, positions);
  const double edge = std::sqrt(areas.sum() / static_cast<double>(areas.size()));
  const double length = options.stiffness_edges * edge;
  const SparseMatrix stiffness =
      bending_energy(laplacian(skin.triangles, positions), areas,
                     Eigen::VectorXd::Constant(areas.size(), std::pow(length, 4)));
  Positions result = positions;
  for (int round = 0; round < options.rounds; ++round) {
    const Positions normals = skin_normals(skin, result);
    Eigen::VectorXd weights = kUnasked * areas, values = Eigen::VectorXd::Zero(areas.size());
    parallel_blocks(areas.size(), 256, [&](auto begin, auto end) {
      for (auto v = begin; v < end; ++v) {
        if (skin.openness[static_cast<std::size_t>(v)] < kLeastOpenness) continue;
        const Eigen::Vector3d point = result.row(v).transpose(), normal = normals.row(v).transpose();
        const auto place = scan.nearest(point, normal, kLeastCosine, options.reach_mm);
        if (!place.found) continue;
        const double off = dot3(place.point - point, place.normal) / dot3(normal, place.normal);
        const double share = off / options.reach_mm;
        values(v) = off;
        weights(v) += areas(v) / ((1 + share * share) * (1 + share * share));
      }
    });
    const Eigen::VectorXd along = smooth_fit(stiffness, weights, values);
    for (Index v = 0; v < result.rows(); ++v) result.row(v) += along(v) * normals.row(v);
  }
  return result;
}

}  // namespace crowdface
