// SPDX-License-Identifier: Apache-2.0
#include "crowdface/heads/face_shapes.h"

#include <algorithm>

#include "crowdface/heads/named_parts.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

/// The fraction of a displacement field that remains after one smoothing iteration, from the
/// field's Rayleigh quotient under the one-ring mean.
double kept_by_smoothing(const Adjacency& adjacency, const Displacements& moves,
                         OperatorKind kind) {
  Positions whole = Positions::Zero(adjacency.vertex_count(), 3);
  moves.add_to(whole);
  double all = 0, with_neighbours = 0;
  for (const std::uint32_t v : moves.vertices) {
    const Eigen::Vector3d here = row3(whole, v);
    for (const std::uint32_t other : adjacency.items_of(v)) {
      all += here.squaredNorm();
      with_neighbours += here.dot(row3(whole, other));
    }
  }
  const double kept = all > 0 ? std::max(with_neighbours / all, 0.0) : 1;
  return kind == OperatorKind::kLazy ? (1 + kept) / 2 : kept;
}

double power(double base, std::uint64_t exponent) {
  double result = 1;
  for (; exponent > 0; exponent /= 2, base *= base) {
    if (exponent % 2 == 1) result *= base;
  }
  return result;
}

/// Returns the weights of the heads' shape sets in a region, normalised to the sum 1. Before the
/// normalisation, the weight of head h is t(h) − Σ_b w_b(h) r_b. t(h) is the weight of h in the
/// target. w_b(h) is the weight of h in band b (see weights_by_level). r_b is the fraction of the
/// shape that smoothing to the level of band b removes.
/// \param kept  the fraction of the shape that one smoothing iteration keeps, see kept_by_smoothing
ShapeSetShares shares_in(const Recipe& recipe, std::size_t region, std::size_t heads, double kept) {
  std::vector<double> shares(heads, 0.0);
  for (const SourceWeight& part : target_head_weights(recipe)) {
    shares[static_cast<std::size_t>(part.head)] += part.weight;
  }
  for (const LevelWeights& band : weights_by_level(recipe, region, Extrapolation::kNone)) {
    const double lost = 1 - power(kept, band.level);
    for (const SourceWeight& part : band.weights) {
      shares[static_cast<std::size_t>(part.head)] -= lost * part.weight;
    }
  }
  double sum = 0;
  for (const double share : shares) sum += share;
  ShapeSetShares result;
  for (std::uint32_t h = 0; h < heads; ++h) {
    if (shares[h] != 0) result.push_back({h, shares[h] / sum});
  }
  return result;
}

}  // namespace

FaceShapes::FaceShapes(const Config& config, const Inputs& inputs) : inputs_(inputs) {
  const ShapeSet& set = inputs.shapes;
  if (set.shapes.empty()) return;
  transfer_ = std::make_unique<ShapeTransfer>(inputs.head_set, inputs.adjacency, inputs.parts,
                                              head_axes(config), set, inputs.regions);
  if (set.head_shapes.empty()) return;
  for (const Shape& shape : set.shapes) {
    shape_fractions_kept_per_smoothing_iteration_.push_back(
        kept_by_smoothing(inputs.adjacency, shape.moves, config.smoothing.operator_kind));
  }
}

std::vector<RegionShares> FaceShapes::shares_of(const Recipe& recipe) const {
  std::vector<RegionShares> shares;
  for (const double kept : shape_fractions_kept_per_smoothing_iteration_) {
    RegionShares& of_shape = shares.emplace_back();
    for (std::size_t k = 0; k < recipe.regions.size(); ++k) {
      of_shape.push_back(shares_in(recipe, k, inputs_.head_set.heads.size(), kept));
    }
  }
  return shares;
}

std::vector<Displacements> FaceShapes::shapes_of_face(const Recipe& recipe, const Positions& face,
                                                      std::vector<Index>* crossing) const {
  if (!transfer_) return {};
  return transfer_->transfer_to_face(recipe.target, face, shares_of(recipe), crossing);
}

std::optional<std::size_t> FaceShapes::prerequisite_of(std::size_t shape) const {
  return transfer_->prerequisite_of(shape);
}

std::vector<Displacements> FaceShapes::shapes_of_head(Index head) const {
  if (!transfer_) return {};
  const ShapeSetShares own = {{static_cast<std::uint32_t>(head), 1}};
  const RegionShares everywhere(static_cast<std::size_t>(inputs_.regions.alpha.cols()), own);
  return transfer_->transfer_to_face(
      head, inputs_.head_set.heads[static_cast<std::size_t>(head)].positions,
      std::vector<RegionShares>(shape_fractions_kept_per_smoothing_iteration_.size(), everywhere));
}

std::size_t FaceShapes::memory_bytes() const {
  if (!transfer_) return 0;
  return displacement_bytes(inputs_.shapes) + transfer_->memory_bytes();
}

}  // namespace crowdface
