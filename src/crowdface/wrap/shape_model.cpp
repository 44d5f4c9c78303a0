// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/shape_model.h"

#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/smooth/symmetric_eigen.h"

namespace crowdface {
namespace {

constexpr std::ptrdiff_t kModelBlock = 4096;

}  // namespace

Positions ShapeModel::evaluate(const Eigen::VectorXd& coefficients) const {
  Positions result = mean;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    result += coefficients(static_cast<Index>(k)) * modes[k];
  }
  return result;
}

ShapeModel make_shape_model(const std::vector<Positions>& heads) {
  require(!heads.empty(), "a model is made of heads, and there is none");
  const auto count = static_cast<Index>(heads.size());
  ShapeModel model;
  model.mean = Positions::Zero(heads[0].rows(), 3);
  for (const Positions& head : heads) model.mean += head;
  model.mean /= static_cast<double>(count);
  std::vector<Positions> differences;
  for (const Positions& head : heads) differences.emplace_back(head - model.mean);
  Eigen::MatrixXd gram(count, count);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j <= i; ++j) {
      const Positions &one = differences[static_cast<std::size_t>(i)],
                      &other = differences[static_cast<std::size_t>(j)];
      gram(i, j) = gram(j, i) = parallel_dot(one.data(), other.data(), one.size(), kModelBlock);
    }
  }
  const SymmetricEigen eigen = symmetric_eigen(gram);
  // smallest eigenvalue, relative to the largest, that yields a mode; identical heads yield no
  // modes
  constexpr double kMinEigenvalue = 1e-9;
  for (Index k = 0; k + 1 < count; ++k) {
    if (eigen.eigenvalues(k) <= kMinEigenvalue * eigen.eigenvalues(0)) break;
    Positions mode = Positions::Zero(model.mean.rows(), 3);
    // For a unit eigenvector v of the Gram matrix with eigenvalue λ, Σ_i v_i differences_i has the
    // length √λ. The standard deviation of the heads in this direction is √(λ / (count − 1)).
    for (Index i = 0; i < count; ++i) {
      mode += eigen.eigenvectors(i, k) * differences[static_cast<std::size_t>(i)];
    }
    model.modes.emplace_back(mode / std::sqrt(static_cast<double>(count - 1)));
  }
  return model;
}

ShapeModel add_mirror_images(const ShapeModel& model, const MirrorMap& map) {
  ShapeModel both{model.mean, {}};
  const Positions image = mirrored(map, model.mean);
  for (const Positions& mode : model.modes) {
    both.modes.emplace_back(mode / std::sqrt(2.0));
    both.modes.emplace_back((mirrored(map, model.mean + mode) - image) / std::sqrt(2.0));
  }
  return both;
}

}  // namespace crowdface
