// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "crowdface/synth/hair_cut.h"

namespace crowdface::synth {

/// From the average head's skin, the ears as lumps; centimetres.
double head_distance(const Eigen::Vector3d& p);
Eigen::Vector3d away_from_head(const Eigen::Vector3d& p);

/// The large form of hair of one cut on the average head. Points are on or near its scalp, centimetres.
class HairForm {
 public:
  explicit HairForm(const HairCut& cut) : cut_(cut) {}

  /// Centimetres from the edge of where hair grows, inwards.
  double within(const Eigen::Vector3d& p) const;
  /// How far all of the hair stands off the scalp; flat at its edges and where it is parted.
  double stand_off(const Eigen::Vector3d& p) const;
  /// Which way it is combed, a unit vector along the scalp.
  Eigen::Vector3d combed(const Eigen::Vector3d& p) const;

 private:
  const HairCut& cut_;
};

/// What lies below the cards, so that nobody sees between them: the scalp where hair grows, lifted to where it
/// stands. Shows the last strip of hair_picture, with tips at the edge.
Mesh hair_cap(const HairCut& cut);

}  // namespace crowdface::synth
