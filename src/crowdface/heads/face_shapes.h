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

/// Expressions of a crowd's faces: what the faces share is found once.
class FaceShapes {
 public:
  /// \param inputs  must outlive this object.
  FaceShapes(const Config& config, const Inputs& inputs);

  /// Of a face built from a recipe, one for each of the inputs' shapes; none without shapes. Where the heads
  /// have shapes of their own, those of the heads that the recipe takes, as it takes them at each region.
  /// \param crossing  as ShapeTransfer::carry takes it
  std::vector<Displacements> of_face(const Recipe& recipe, const Positions& face,
                                     std::vector<Index>* crossing = nullptr) const;
  /// Of one of the heads.
  std::vector<Displacements> of_head(Index head) const;

  /// The shape to which one is made to be added, see companions_of.
  std::optional<std::size_t> companion(std::size_t shape) const;
  std::size_t memory_bytes() const;

 private:
  std::vector<RegionShares> shares_of(const Recipe& recipe) const;

  const Inputs& inputs_;
  std::vector<double>
      kept_;  ///< #shapes: how much of each is left after one iteration of smoothing
  std::unique_ptr<const ShapeTransfer> transfer_;  ///< if there are shapes
};

}  // namespace crowdface
