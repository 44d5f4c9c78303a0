// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

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

struct LocalOptions {
  double reach_mm = 60;  ///< how far around a place what differs there goes together
  double share = 0.4;    ///< of the variance that is local; the other goes together everywhere
};
/// The same model with tapered covariances: about each place heads vary more or less on their own, so that
/// few heads say much. Has (places + 1) times the modes.
/// Source: Lüthi et al. 2018, "Gaussian process morphable models".
/// \param places  rows of the model, at least one
ShapeModel localised(const ShapeModel& model, const std::vector<std::uint32_t>& places,
                     const LocalOptions& options = {});

}  // namespace crowdface
