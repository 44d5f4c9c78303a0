// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/mesh/mirror_map.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// How the heads of a topology differ: their mean and principal directions.
struct ShapeModel {
  Positions mean;                ///< #V by 3
  std::vector<Positions> modes;  ///< #V by 3 each, as long as one standard deviation, longest first

  /// mean + Σ c_k modes_k
  Positions shape(const Eigen::VectorXd& coefficients) const;
};

/// Of heads that stand in one place (#V by 3 each, at least one): as many modes as heads less one.
/// Source: Blanz & Vetter 1999, "A morphable model for the synthesis of 3D faces".
ShapeModel make_model(const std::vector<Positions>& heads);

/// The same model, and of each of its heads the mirror image: has twice the modes.
ShapeModel with_mirror_images(const ShapeModel& model, const MirrorMap& map);

}  // namespace crowdface
