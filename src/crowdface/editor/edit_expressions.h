// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/blend/recipe.h"
#include "crowdface/heads/face_attachments.h"
#include "crowdface/heads/face_shapes.h"
#include "crowdface/run/job.h"

namespace crowdface {

/// Expressions of the edited face. Thread-safe.
class EditExpressions {
 public:
  /// For each of several expressions: the vertex displacements, already multiplied by the
  /// expression's weight.
  using WeightedDisplacements = std::vector<Displacements>;

  /// \param job  must outlive this object.
  explicit EditExpressions(const Job& job) : job_(job) {}

  /// The names of the expressions.
  std::vector<std::string> names() const;
  /// Returns the weighted displacements of a face for the expressions in `weights`. Computes the
  /// displacements of all expressions of a face at once, and caches them until the face changes.
  /// \param weights    {name: weight 0 … 1}; missing expressions have weight 0
  /// \param positions  vertices of the face without expressions, #V by 3
  /// \throws UsageError if a name does not exist or a weight is outside its range.
  WeightedDisplacements weighted_displacements(const nlohmann::ordered_json& weights,
                                               const Recipe& recipe, const Positions& positions);

 private:
  const Job& job_;
  std::mutex mutex_;
  /// computes displacements; null until the first request
  std::unique_ptr<const FaceShapes> shapes_;
  Positions cached_face_;  ///< the face for which `cached_displacements_` was computed
  /// for each expression: the vertex displacements of `cached_face_` at weight 1
  std::vector<Displacements> cached_displacements_;
};

}  // namespace crowdface
