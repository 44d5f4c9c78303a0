// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/follow_detail.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/smooth/iterate.h"
#include "crowdface/wrap/growing_patch.h"
#include "crowdface/wrap/shape_fit.h"

namespace crowdface {
namespace {

constexpr double kReachMm = 3;
/// Smoothing scale, as a multiple of the skin's edge length. Relief finer than this scale is
/// treated as noise.
constexpr double kSmoothingScaleEdges = 0.5;
constexpr int kDetailRounds = 2;
constexpr double kMinNormalCosine = 0.7;  // least cosine between the normals of scan and skin
constexpr double kMinDetailVisibility = 0.15;
constexpr double kNoDataWeight = 1e-4;  ///< weight of a zero offset at vertices without scan data
constexpr int kSteps = 30;
/// Limits of even_out_folds: largest number of rounds, number of initial rounds (which do not
/// shrink the offsets), and number of averaging sweeps in each round.
constexpr int kMaxAveragingRounds = 10, kPureAveragingRounds = 3, kSweeps = 8;
/// Factor by which each sweep shrinks the offsets, in the rounds after the initial rounds.
constexpr double kSweepFactor = 0.98;
/// Smallest allowed ratio of two areas of a triangle: the area after the move, projected onto the
/// triangle's plane before the move, divided by the area before the move.
constexpr double kMinAreaRatio = 0.05;
/// Smallest allowed cosine between a triangle's normal on the deformed skin and its normal on the
/// template.
constexpr double kMinFaceCosine = 0.05;

constexpr std::ptrdiff_t kDetailBlock = 8192;

double product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return parallel_dot(a.data(), b.data(), a.size(), kDetailBlock);
}

/// Solves (W + c Uᵀ U) x = W r. W is the diagonal matrix of the weights, c the stiffness, and r the
/// target values. U x is, for each vertex, the difference between the vertex's value and the mean
/// of its neighbours' values. Uses conjugate gradients with the diagonal as preconditioner; this is
/// sufficient because the stiffness acts over only one or two edges.
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
    parallel_for_each(x.size(), kDetailBlock, [&](Index i) {
      const auto around = adjacency_.items_of(i);
      double sum = 0;
      for (const std::uint32_t n : around) sum += x(n);
      off(i) = around.empty() ? 0 : x(i) - sum / static_cast<double>(around.size());
    });
    parallel_for_each(x.size(), kDetailBlock, [&](Index i) {
      double sum = off(i);
      for (const std::uint32_t n : adjacency_.items_of(i)) {
        sum -= off(n) / static_cast<double>(adjacency_.items_of(n).size());
      }
      y(i) = weights(i) * x(i) + stiffness_ * sum;
    });
    return y;
  }

  const Adjacency& adjacency_;
  double stiffness_;
};

/// How far the skin's vertices should move along their normals to reach the scan.
struct TargetOffsets {
  Eigen::VectorXd weights, values;  ///< one weight and one offset for each vertex of the skin
};

TargetOffsets ask_scan(const SkinMesh& skin, const Positions& positions, const Positions& normals,
                       const ScanSurface& scan) {
  TargetOffsets asked{Eigen::VectorXd::Constant(positions.rows(), kNoDataWeight),
                      Eigen::VectorXd::Zero(positions.rows())};
  parallel_blocks(positions.rows(), 256, [&](Index begin, Index end) {
    std::uint32_t before = kNoIndex;
    for (Index v = begin; v < end; ++v) {
      if (skin.ambient_visibility[static_cast<std::size_t>(v)] < kMinDetailVisibility) continue;
      const Eigen::Vector3d point = row3(positions, v), normal = row3(normals, v);
      const auto place = scan.nearest(point, normal, kMinNormalCosine, kReachMm, before);
      before = place.triangle;
      if (!place.is_found) continue;
      const double off = (place.point - point).dot(place.normal) / normal.dot(place.normal);
      const double share = off / kReachMm;
      asked.values(v) = off;
      asked.weights(v) += 1 / ((1 + share * share) * (1 + share * share));
    }
  });
  return asked;
}

/// Whether the offsets flip a triangle. Compares the result with the triangle in `before` and in
/// `rest_positions` (the template). Skips the second comparison if the triangle in `before` is
/// already flipped relative to the template.
bool flips(const Positions& rest_positions, const Positions& before, const Positions& normals,
           const Eigen::VectorXd& along, const Triangle& t) {
  const auto moved = [&](std::uint32_t v) -> Eigen::Vector3d {
    return row3(before, v) + along(v) * row3(normals, v);
  };
  const Eigen::Vector3d was = area_vector(before, t), first = moved(t[0]);
  const Eigen::Vector3d is = (moved(t[1]) - first).cross(moved(t[2]) - first);
  if (was.dot(is) <= kMinAreaRatio * was.squaredNorm()) return true;
  const Eigen::Vector3d of_rest = area_vector(rest_positions, t);
  const double least = kMinFaceCosine * of_rest.norm();
  return of_rest.dot(is) <= least * is.norm() && of_rest.dot(was) > least * was.norm();
}

/// The triangles that the offsets flip; checks only triangles with a changed vertex.
std::vector<std::uint32_t> flipped_triangles(const SkinMesh& skin, const Positions& rest_positions,
                                             const Positions& before, const Positions& normals,
                                             const Eigen::VectorXd& along,
                                             const std::vector<char>& changed) {
  std::vector<char> is_turned(skin.triangles.size(), 0);
  parallel_for_each(skin.triangles.size(), kDetailBlock, [&](std::size_t i) {
    const Triangle& t = skin.triangles[i];
    if (changed[t[0]] + changed[t[1]] + changed[t[2]] == 0) return;
    is_turned[i] = flips(rest_positions, before, normals, along, t) ? 1 : 0;
  });
  std::vector<std::uint32_t> turned;
  for (std::uint32_t i = 0; i < is_turned.size(); ++i) {
    if (is_turned[i] != 0) turned.push_back(i);
  }
  return turned;
}

/// Reduces the offsets in a patch around each flipped triangle: to zero at the triangle, and less
/// and less towards the border of the patch.
void reduce_offsets(const Positions& rest_positions, const Positions& before,
                    const Positions& normals, std::span<const std::uint32_t> turned,
                    const PatchMender& mender, Eigen::VectorXd& along) {
  const auto is_bad = [&](const Triangle& t) {
    return flips(rest_positions, before, normals, along, t);
  };
  Eigen::VectorXd asked;
  const PatchChange change{
      .make =
          [&](const GrowingPatch& patch) {
            const auto rows = patch.vertices();
            asked = along(rows);
            for (std::size_t i = 0; i < rows.size(); ++i) along(rows[i]) *= 1 - patch.weight(i);
          },
      .undo = [&](const GrowingPatch& patch) { along(patch.vertices()) = asked; }};
  mender.mend(turned, is_bad, change);
}

/// Removes folds that arise if the closest points of neighbouring vertices lie on different layers
/// of the scan. Replaces each offset near a fold by the mean of the neighbours' offsets, and
/// enlarges the treated area until the fold is gone or a limit is reached.
/// \param mender  repairs the skin; created on first use.
void even_out_folds(const SkinMesh& skin, const Positions& rest_positions, const Positions& before,
                    const Positions& normals, std::optional<PatchMender>& mender,
                    Eigen::VectorXd& along) {
  std::vector<char> uneven(skin.vertices.size(), 1);
  const auto find = [&] {
    return flipped_triangles(skin, rest_positions, before, normals, along, uneven);
  };
  std::vector<std::uint32_t> turned = find();
  std::fill(uneven.begin(), uneven.end(), 0);
  std::vector<std::uint32_t> evened;  // ascending
  const auto add = [&](std::uint32_t v) {
    if (uneven[v] == 0) evened.push_back(v);
    uneven[v] = 1;
  };
  for (int round = 0; round < kMaxAveragingRounds && !turned.empty(); ++round) {
    for (const std::uint32_t i : turned) {
      for (const std::uint32_t v : skin.triangles[i]) {
        add(v);
        for (const std::uint32_t n : skin.adjacency.items_of(v)) add(n);
      }
    }
    std::ranges::sort(evened);
    // In later rounds, also shrink the offsets a little in each sweep. In a crease, the normals of
    // neighbouring vertices cross, so that even equal offsets along the normals produce folds.
    const double kept = round < kPureAveragingRounds ? 1 : kSweepFactor;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (const std::uint32_t v : evened) {
        const auto around = skin.adjacency.items_of(v);
        double sum = 0;
        for (const std::uint32_t n : around) sum += along(n);
        along(v) = kept * sum / static_cast<double>(around.size());
      }
    }
    turned = find();
  }
  if (turned.empty()) return;
  if (!mender) mender.emplace(skin, rest_positions);
  reduce_offsets(rest_positions, before, normals, turned, *mender, along);
}

void move_along(const Positions& normals, const Eigen::VectorXd& along, Positions& positions) {
  for (Index v = 0; v < positions.rows(); ++v) positions.row(v) += along(v) * normals.row(v);
}

}  // namespace

Positions follow_detail(const SkinMesh& skin, const Positions& rest_positions,
                        const Positions& positions, const ScanSurface& scan, int smoothing_steps) {
  std::optional<PatchMender> mender;
  Positions result = positions;
  Positions normals = vertex_normals_or_zero(skin.triangles, result);
  if (smoothing_steps > 0) {
    const SmoothingOperator lazy(skin.adjacency, Boundary::kFree, OperatorKind::kLazy);
    const auto times = static_cast<std::uint64_t>(smoothing_steps);
    normals = iterate(lazy, normals, times);
    for (Index v = 0; v < normals.rows(); ++v)
      normals.row(v) = row3(normals, v).normalized().transpose();
    const TargetOffsets asked = ask_scan(skin, result, normals, scan);
    Columns sums(result.rows(), 2);
    sums << asked.weights.cwiseProduct(asked.values), asked.weights;
    sums = iterate(lazy, sums, times);
    Eigen::VectorXd along = sums.col(0).cwiseQuotient(sums.col(1));
    even_out_folds(skin, rest_positions, result, normals, mender, along);
    move_along(normals, along, result);
  }
  // SmoothFit penalises the squared difference between the value at a vertex and the mean of the
  // neighbours' values. On a regular mesh with edge length h, this difference is h²/4 times the
  // Laplacian Δ. With the scale s = kSmoothingScaleEdges · h, the factor below therefore gives the
  // penalty (s² Δ)².
  const SmoothFit fit(skin.adjacency, 16 * std::pow(kSmoothingScaleEdges, 4));
  for (int round = 0; round < kDetailRounds; ++round) {
    if (smoothing_steps == 0) normals = vertex_normals_or_zero(skin.triangles, result);
    const TargetOffsets asked = ask_scan(skin, result, normals, scan);
    Eigen::VectorXd along = fit.solve(asked.weights, asked.values);
    even_out_folds(skin, rest_positions, result, normals, mender, along);
    move_along(normals, along, result);
  }
  return result;
}

}  // namespace crowdface
