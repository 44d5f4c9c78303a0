// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/mirror_map.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A linear model of the heads of a topology: mean and principal components.
struct ShapeModel {
  Positions mean;  ///< #V by 3
  /// #V by 3 each, scaled to one standard deviation; the mode with the largest deviation first
  std::vector<Positions> modes;

  /// Returns the shape mean + Σ c_k modes_k for the coefficients c.
  Positions evaluate(const Eigen::VectorXd& coefficients) const;
};

/// Builds a model of aligned heads (#V by 3 each, at least one). The number of modes is the number
/// of heads minus one. Source: Blanz & Vetter 1999, "A morphable model for the synthesis of 3D
/// faces".
ShapeModel make_shape_model(const std::vector<Positions>& heads);

/// The model of the heads and their mirror images; has twice as many modes.
ShapeModel add_mirror_images(const ShapeModel& model, const MirrorMap& map);

}  // namespace crowdface
