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

/// What the scan asks of each vertex, along its normal.
struct Asked {
  Eigen::VectorXd weights, values;  ///< #skin
};

Asked ask_scan(const SkinMesh& skin, const Positions& positions, const Positions& normals,
               const ScanSurface& scan, double reach) {
  Asked asked{Eigen::VectorXd::Constant(positions.rows(), kUnasked),
              Eigen::VectorXd::Zero(positions.rows())};
  parallel_blocks(positions.rows(), 256, [&](Index begin, Index end) {
    std::uint32_t before = kNoIndex;
    for (Index v = begin; v < end; ++v) {
      if (skin.openness[static_cast<std::size_t>(v)] < kLeastOpenness) continue;
      const Eigen::Vector3d point = row3(positions, v), normal = row3(normals, v);
      const auto place = scan.nearest(point, normal, kLeastCosine, reach, before);
      before = place.triangle;
      if (!place.found) continue;
      const double off = dot3(place.point - point, place.normal) / dot3(normal, place.normal);
      const double share = off / reach;
      asked.values(v) = off;
      asked.weights(v) += 1 / ((1 + share * share) * (1 + share * share));
    }
  });
  return asked;
}

void move_along(const Positions& normals, const Eigen::VectorXd& along, Positions& positions) {
  for (Index v = 0; v < positions.rows(); ++v) positions.row(v) += along(v) * normals.row(v);
}

}  // namespace

Positions follow_detail(const SkinMesh& skin, const Positions& positions, const ScanSurface& scan,
                        const DetailOptions& options) {
  Positions result = positions;
  Positions normals = vertex_normals(skin.triangles, result);
  if (options.smoothings > 0) {
    const SmoothingOperator lazy(skin.adjacency, Boundary::kFree, OperatorKind::kLazy);
    const auto times = static_cast<std::uint64_t>(options.smoothings);
    normals = iterate(lazy, normals, times);
    for (Index v = 0; v < normals.rows(); ++v) normals.row(v) = unit3(row3(normals, v)).transpose();
    const Asked asked = ask_scan(skin, result, normals, scan, options.reach_mm);
    Columns sums(result.rows(), 2);
    sums << asked.weights.cwiseProduct(asked.values), asked.weights;
    sums = iterate(lazy, sums, times);
    move_along(normals, sums.col(0).cwiseQuotient(sums.col(1)), result);
  }
  // On a regular mesh of edges h the mean of the neighbours is h²/4 times the Laplacian away.
  const SmoothFit fit(skin.adjacency, 16 * std::pow(options.stiffness_edges, 4));
  for (int round = 0; round < options.rounds; ++round) {
    if (options.smoothings == 0) normals = vertex_normals(skin.triangles, result);
    const Asked asked = ask_scan(skin, result, normals, scan, options.reach_mm);
    move_along(normals, fit.solve(asked.weights, asked.values), result);
  }
  return result;
}

}  // namespace crowdface
