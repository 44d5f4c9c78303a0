// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/config/config.h"
#include "crowdface/heads/inputs.h"
#include "crowdface/shapes/shape_transfer.h"

namespace crowdface {

/// Computes the shapes (expressions) of a crowd's faces. The constructor computes once the data
/// that does not depend on the face.
class FaceShapes {
 public:
  /// \param inputs  must outlive this object.
  FaceShapes(const Config& config, const Inputs& inputs);

  /// The shapes (expressions) of a face built from a recipe: one for each shape of the inputs, or
  /// none if the inputs have no shapes. If the heads have shapes of their own, each region blends
  /// the shapes of the recipe's source heads with the recipe's weights.
  /// \param crossing  optional output, see `crossing_counts` of ShapeTransfer::transfer_to_face
  std::vector<Displacements> shapes_of_face(const Recipe& recipe, const Positions& face,
                                            std::vector<Index>* crossing = nullptr) const;
  /// The shapes (expressions) of an input head.
  std::vector<Displacements> shapes_of_head(Index head) const;

  /// Returns the shape with which a corrective shape must be applied (see find_prerequisites);
  /// nothing if `shape` is not corrective.
  std::optional<std::size_t> prerequisite_of(std::size_t shape) const;
  std::size_t memory_bytes() const;

 private:
  /// For each shape, the weights of the heads' shape sets in each region of a face; empty if the
  /// heads have no shapes of their own.
  std::vector<RegionShares> shares_of(const Recipe& recipe) const;

  const Inputs& inputs_;
  /// one per shape: the fraction of the shape's displacements that remains after one smoothing
  /// iteration
  std::vector<double> shape_fractions_kept_per_smoothing_iteration_;
  /// computes the shapes of a face; null if the inputs have no shapes
  std::unique_ptr<const ShapeTransfer> transfer_;
};

}  // namespace crowdface
