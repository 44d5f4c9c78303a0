// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_expressions.h"

#include <algorithm>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/page/answer_request.h"

namespace crowdface {

std::vector<std::string> EditExpressions::names() const {
  std::vector<std::string> names;
  for (const Shape& shape : job_.inputs.shapes.shapes) names.push_back(shape.name);
  return names;
}

EditExpressions::WeightedDisplacements EditExpressions::weighted_displacements(
    const nlohmann::ordered_json& weights, const Recipe& recipe, const Positions& positions) {
  if (!weights.is_object())
    throw UsageError("expression: expected a mapping from names of shapes to weights");
  const std::vector<std::string> known = names();
  std::vector<std::pair<std::size_t, double>> wanted;
  for (const auto& [name, ignored] : weights.items()) {
    const auto found = std::ranges::find(known, name);
    if (found == known.end()) {
      throw UsageError(concat("expression: expected a shape of the config, found ", quoted(name)));
    }
    const double weight = number_in(weights, name, 0, 1);
    if (weight > 0) wanted.emplace_back(found - known.begin(), weight);
  }
  WeightedDisplacements moves;
  if (wanted.empty()) return moves;
  const std::lock_guard lock(mutex_);
  if (!shapes_) shapes_ = std::make_unique<const FaceShapes>(job_.config, job_.inputs);
  if (cached_face_.rows() != positions.rows() || cached_face_ != positions) {
    cached_displacements_ = shapes_->shapes_of_face(recipe, positions);
    cached_face_ = positions;
  }
  for (const auto& [shape, weight] : wanted) {
    moves.push_back(cached_displacements_[shape]);
    moves.back().moves *= weight;
  }
  return moves;
}

}  // namespace crowdface
