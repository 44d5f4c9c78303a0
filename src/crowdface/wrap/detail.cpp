// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/detail.h"

#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/smooth/iterate.h"
#include "crowdface/wrap/shape_fit.h"

namespace crowdface {
namespace {

constexpr double kLeastCosine = 0.7;  // of the scan's normal with the skin's, so that it is no wall
constexpr double kLeastOpenness = 0.15;
constexpr double kUnasked = 1e-4;  ///< weight of staying where the scan says nothing
constexpr int kSteps = 30;

constexpr std::ptrdiff_t kBlock = 8192;

double product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return parallel_dot(a.data(), b.data(), a.size(), kBlock);
}

/// Solves (W + c Uᵀ U) x = W r, U x being what a value differs by from the mean of its neighbours, by
/// conjugate gradients with the diagonal as preconditioner: enough where stiffness reaches over an
/// edge or two.
class SmoothFit {
 public:
  SmoothFit(const Adjacency& adjacency, double stiffness)
      : adjacency_(adjacency), stiffness_(stiffness) {}

  Eigen::VectorXd solve(const Eigen::VectorXd& weights, const Eigen::VectorXd& values) const {
    const Eigen::VectorXd scale = (weights.array() + stiffness_).inverse();
    Eigen::VectorXd x = values.cwiseProduct(weights).cwiseProduct(scale);
    Eigen::VectorXd residual = weights.cwiseProduct(values) - times(weights, x);
    Eigen::VectorXd direction = scale.cwiseProduct(residual);
    double rho = product(residual, direction);
    const double enough = 1e-8 * rho;
    for (int k = 0; k < kSteps && rho > enough; ++k) {
      const Eigen::VectorXd image = times(weights, direction);
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

 private:
  Eigen::VectorXd times(const Eigen::VectorXd& weights, const Eigen::VectorXd& x) const {
    Eigen::VectorXd off(x.size()), y(x.size());
    parallel_for_each(x.size(), kBlock, [&](Index i) {
      const auto around = adjacency_.of(i);
      double sum = 0;
      for (const std::uint32_t n : around) sum += x(n);
      off(i) = around.empty() ? 0 : x(i) - sum / static_cast<double>(around.size());
    });
    parallel_for_each(x.size(), kBlock, [&](Index i) {
      double sum = off(i);
      for (const std::uint32_t n : adjacency_.of(i)) {
        sum -= off(n) / static_cast<double>(adjacency_.of(n).size());
      }
      y(i) = weights(i) * x(i) + stiffness_ * sum;
    });
    return y;
  }

  const Adjacency& adjacency_;
  double stiffness_;
};

Positions smoothed_normals(const SkinMesh& skin, const Positions& positions, int times) {
  Positions normals = vertex_normals(skin.triangles, positions);
  if (times == 0) return normals;
  const SmoothingOperator lazy(skin.adjacency, Boundary::kFree, OperatorKind::kLazy);
  normals = iterate(lazy, normals, static_cast<std::uint64_t>(times));
  for (Index v = 0; v < normals.rows(); ++v) normals.row(v) = unit3(row3(normals, v)).transpose();
  return normals;
}

}  // namespace

Positions follow_detail(const SkinMesh& skin, const Positions& positions, const ScanSurface& scan,
                        const DetailOptions& options) {
  // On a regular mesh of edges h the mean of the neighbours is h²/4 times the Laplacian away.
  const SmoothFit fit(skin.adjacency, 16 * std::pow(options.stiffness_edges, 4));
  Positions result = positions;
  for (int round = 0; round < options.rounds; ++round) {
    const Positions normals = smoothed_normals(skin, result, options.normal_smoothings);
    Eigen::VectorXd weights = Eigen::VectorXd::Constant(result.rows(), kUnasked);
    Eigen::VectorXd values = Eigen::VectorXd::Zero(result.rows());
    parallel_for_each(result.rows(), 256, [&](Index v) {
      if (skin.openness[static_cast<std::size_t>(v)] < kLeastOpenness) return;
      const Eigen::Vector3d point = row3(result, v), normal = row3(normals, v);
      const auto place = scan.nearest(point, normal, kLeastCosine, options.reach_mm);
      if (!place.found) return;
      const double off = dot3(place.point - point, place.normal) / dot3(normal, place.normal);
      const double share = off / options.reach_mm;
      values(v) = off;
      weights(v) += 1 / ((1 + share * share) * (1 + share * share));
    });
    const Eigen::VectorXd along = fit.solve(weights, values);
    for (Index v = 0; v < result.rows(); ++v) result.row(v) += along(v) * normals.row(v);
  }
  return result;
}

}  // namespace crowdface
