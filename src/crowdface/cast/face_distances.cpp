// SPDX-License-Identifier: Apache-2.0
#include "crowdface/cast/face_distances.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/mesh/alignment.h"

namespace crowdface {
namespace {

/// The rigid alignment moves this number of vertices at a time.
constexpr Index kVerticesPerBlock = 1024;

double distance_of_views(const Eigen::Ref<const Positions>& a, const Eigen::Ref<const Positions>& b,
                         const Eigen::VectorXd& weights) {
  const Similarity motion = fit_similarity(b, a, ScaleFit::kRigid, weights);
  double squared = 0, total = 0;
  for (Index first = 0; first < a.rows(); first += kVerticesPerBlock) {
    const Index count = std::min(kVerticesPerBlock, a.rows() - first);
    const Positions moved = motion.apply(b.middleRows(first, count));
    for (Index i = 0; i < count; ++i) {
      squared += weights(first + i) * (a.row(first + i) - moved.row(i)).squaredNorm();
      total += weights(first + i);
    }
  }
  return std::sqrt(squared / total);
}

Eigen::VectorXd vector_of(const std::vector<double>& areas) {
  return Eigen::VectorXd::Map(areas.data(), static_cast<Index>(areas.size()));
}

}  // namespace

double face_distance(const Positions& a, const Positions& b, const std::vector<double>& areas) {
  return distance_of_views(a, b, vector_of(areas));
}

Eigen::MatrixXd face_distances(std::span<const Eigen::Map<const Positions>> faces,
                               const std::vector<double>& areas) {
  const Eigen::VectorXd weights = vector_of(areas);
  const auto count = static_cast<Index>(faces.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, count);
  parallel_for_each(count, [&](Index i) {
    for (Index j = 0; j < i; ++j) {
      result(i, j) = distance_of_views(faces[static_cast<std::size_t>(i)],
                                       faces[static_cast<std::size_t>(j)], weights);
    }
  });
  return result + result.transpose();
}

}  // namespace crowdface
