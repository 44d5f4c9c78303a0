// SPDX-License-Identifier: Apache-2.0
#include "crowdface/smooth/principal_directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <span>

#include "crowdface/core/fixed_order.h"
#include "crowdface/core/parallel.h"
#include "crowdface/smooth/level_size.h"
#include "crowdface/smooth/symmetric_eigen.h"

namespace crowdface {
namespace {

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(a.rows(), b.cols());
  for (Index j = 0; j < b.cols(); ++j) {
    for (Index k = 0; k < a.cols(); ++k) {
      for (Index i = 0; i < a.rows(); ++i) result(i, j) += a(i, k) * b(k, j);
    }
  }
  return result;
}

/// Returns the upper triangular factor T of the QR factorization F = Q·T, where F is `functions`.
Eigen::MatrixXd triangular_factor(Eigen::MatrixXd functions) {
  const Index count = functions.cols();
  const auto column = [&](Index n) {
    return std::span(functions.col(n).data(), static_cast<std::size_t>(functions.rows()));
  };
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(count, count);
  for (Index n = 0; n < count; ++n) {
    triangle(n, n) = orthonormalize(
        column(n), static_cast<std::size_t>(n),
        [&](std::size_t m) { return column(static_cast<Index>(m)); },
        [&](std::size_t m, double part) { triangle(static_cast<Index>(m), n) += part; });
  }
  return triangle;
}

/// Solves the linear equations T·x = b by back substitution, where T is the upper triangular matrix
/// `triangle`.
Eigen::MatrixXd solve_triangle(const Eigen::MatrixXd& triangle, Eigen::MatrixXd b) {
  for (Index j = 0; j < b.cols(); ++j) {
    for (Index i = triangle.rows(); i-- > 0;) {
      for (Index k = i + 1; k < triangle.rows(); ++k) b(i, j) -= triangle(i, k) * b(k, j);
      b(i, j) /= triangle(i, i);
    }
  }
  return b;
}

/// The matrix, #nodes by #nodes, of the second moments of the nodes' displacements. An element is
/// the dot product of the displacements at two nodes, summed over the sampled vertices.
Eigen::MatrixXd second_moments(const NodeDisplacements& sample) {
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(sample.node_count, sample.node_count);
  const double* vertex = sample.displacements.data();
  for (Index v = 0; v < sample.vertex_count(); ++v, vertex += 3 * sample.node_count) {
    for (Index p = 0; p < sample.node_count; ++p) {
      const double* a = vertex + 3 * p;
      for (Index q = 0; q <= p; ++q) {
        const double* b = vertex + 3 * q;
        moments(p, q) += a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      }
    }
  }
  for (Index p = 0; p < sample.node_count; ++p) {
    for (Index q = 0; q < p; ++q) moments(q, p) = moments(p, q);
  }
  return moments;
}

/// The principal directions that result if the error at level l has the weight `importance(l)`.
PrincipalDirections weighted_directions(const TestedLevels& tested,
                                        const Eigen::VectorXd& importance,
                                        const Eigen::MatrixXd& moments) {
  // A trajectory is the displacement of a sampled vertex at all tested levels. C are the
  // displacements at the nodes. With the node weights N (tested.node_weights), the trajectories are
  // the columns of N·C. Multiply row l of N by importance(l), and let Q·T be the QR factorization
  // of this product. With Z = T·C, the weighted trajectories are Q·Z. Their principal directions
  // are the eigenvectors U of Z·Zᵀ = T·C·Cᵀ·Tᵀ, and Q·Z = (Q·U)·(Uᵀ·T·C).
  const Eigen::MatrixXd t = triangular_factor(importance.asDiagonal() * tested.node_weights);
  const Eigen::MatrixXd u =
      symmetric_eigen(product(product(t, moments), t.transpose())).eigenvectors;
  PrincipalDirections directions;
  directions.function_coefficients = solve_triangle(t, u);
  directions.field_coefficients = product(t.transpose(), u);
  directions.level_functions = product(tested.node_weights, directions.function_coefficients);
  return directions;
}

/// Number of vertices that one loop processes together, so that the compiler can vectorize the
/// loop.
constexpr Index kLanes = 16;
using Lanes = std::array<float, kLanes>;

/// Computes all vector fields c_p (see PrincipalDirections::field_coefficients) at the kLanes
/// vertices from `begin`. Vertices from `end` on get zeros.
/// \param fields  receives 3·#nodes by kLanes.
void combine_fields(const PrincipalDirections& directions, const NodeDisplacements& sample,
                    Index begin, Index end, std::vector<Lanes>& fields) {
  const Index nodes = sample.node_count;
  fields.assign(static_cast<std::size_t>(3 * nodes), Lanes{});
  for (Index v = begin; v < end; ++v) {
    const double* displacement = sample.displacements.data() + 3 * nodes * v;
    for (Index p = 0; p < nodes; ++p) {
      double field[3] = {};
      for (Index n = 0; n < nodes; ++n) {
        for (Index c = 0; c < 3; ++c) {
          field[c] += directions.field_coefficients(n, p) * displacement[3 * n + c];
        }
      }
      for (Index c = 0; c < 3; ++c) {
        fields[static_cast<std::size_t>(3 * p + c)][static_cast<std::size_t>(v - begin)] =
            static_cast<float>(field[c]);
      }
    }
  }
}

/// Returns PrincipalDirections::max_errors: the largest distance of a sampled vertex from its exact
/// position, for each tested level and each number of kept directions (0 to #nodes). The function
/// computes in single precision, which is accurate enough for choosing a rank.
Eigen::MatrixXd max_errors(const PrincipalDirections& directions, const NodeDisplacements& sample) {
  const Index nodes = sample.node_count, levels = directions.level_functions.rows();
  // Transpose the matrix, so that the functions of one level are contiguous.
  const Eigen::MatrixXf functions = directions.level_functions.transpose().cast<float>();
  Eigen::MatrixXf most = Eigen::MatrixXf::Zero(nodes + 1, levels);
  std::mutex mutex;
  constexpr Index kBlock = 32 * kLanes;
  parallel_blocks(sample.vertex_count(), kBlock, [&](Index begin, Index end) {
    std::vector<Lanes> mine(static_cast<std::size_t>(levels * nodes)), fields;
    for (Index v = begin; v < end; v += kLanes) {
      combine_fields(directions, sample, v, std::min(v + kLanes, end), fields);
      for (Index l = 0; l < levels; ++l) {
        Lanes left[3] = {};
        for (Index p = nodes; p-- > 0;) {
          const float function = functions(p, l);
          Lanes squared{};
          for (std::size_t c = 0; c < 3; ++c) {
            const Lanes& field = fields[static_cast<std::size_t>(3 * p) + c];
            for (std::size_t i = 0; i < kLanes; ++i) {
              left[c][i] += function * field[i];
              squared[i] += left[c][i] * left[c][i];
            }
          }
          Lanes& largest = mine[static_cast<std::size_t>(l * nodes + p)];
          for (std::size_t i = 0; i < kLanes; ++i) {
            largest[i] = largest[i] > squared[i] ? largest[i] : squared[i];
          }
        }
      }
    }
    const std::lock_guard lock(mutex);  // maxima may be merged in any order
    for (Index l = 0; l < levels; ++l) {
      for (Index p = 0; p < nodes; ++p) {
        for (const float value : mine[static_cast<std::size_t>(l * nodes + p)]) {
          most(p, l) = std::max(most(p, l), value);
        }
      }
    }
  });
  return most.cast<double>().cwiseSqrt().transpose();
}

/// The smallest number of directions for which the largest error over all levels is at most the
/// tolerance.
Index min_rank(const Eigen::MatrixXd& max_errors, double tolerance) {
  Index rank = 0;
  while (rank + 1 < max_errors.cols() && max_errors.col(rank).maxCoeff() > tolerance) ++rank;
  return rank;
}

}  // namespace

TestedLevels make_tested_levels(const LevelNodes& nodes) {
  constexpr int kSteps = 128;
  std::vector<std::uint64_t> levels = nodes.levels();
  for (const std::uint64_t level : levels_dense_at_start(nodes.max_level(), kSteps)) {
    levels.push_back(level);
    if (level < nodes.max_level()) levels.push_back(level + 1);
  }
  std::ranges::sort(levels);
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  TestedLevels tested{std::move(levels), {}};
  const auto count = static_cast<Index>(nodes.levels().size());
  tested.node_weights.resize(static_cast<Index>(tested.levels.size()), count);
  for (std::size_t l = 0; l < tested.levels.size(); ++l) {
    const std::vector<double> weights = nodes.interpolation_weights(tested.levels[l]);
    for (Index n = 0; n < count; ++n) {
      tested.node_weights(static_cast<Index>(l), n) = weights[static_cast<std::size_t>(n)];
    }
  }
  return tested;
}

PrincipalDirections principal_directions(const TestedLevels& tested,
                                         const NodeDisplacements& sample, double tolerance) {
  constexpr int kRounds = 5;       // more rounds do not lower the rank (docs/method.md)
  constexpr double kFloor = 0.02;  // keeps the importance of every level above zero
  const Eigen::MatrixXd moments = second_moments(sample);
  Eigen::VectorXd importance = Eigen::VectorXd::Ones(tested.node_weights.rows());
  PrincipalDirections best;
  for (int round = 0; round < kRounds; ++round) {
    PrincipalDirections directions = weighted_directions(tested, importance, moments);
    directions.max_errors = max_errors(directions, sample);
    directions.rank = min_rank(directions.max_errors, tolerance);
    const Eigen::MatrixXd distances = directions.max_errors;
    if (round == 0 || directions.rank < best.rank) best = std::move(directions);
    if (best.rank <= 1) break;
    // Reweight the levels: the larger the error at a level, the more its importance grows relative
    // to the importance of the other levels.
    const auto errors = distances.col(best.rank - 1);  // errors with best.rank − 1 directions
    for (Index l = 0; l < importance.size(); ++l) {
      importance(l) *= std::sqrt(errors(l) / errors.maxCoeff() + kFloor);
    }
  }
  return best;
}

}  // namespace crowdface
