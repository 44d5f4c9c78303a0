// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/mesh/topology.h"
#include "head_models/synth/hair_cut.h"

namespace crowdface::synth {

/// From the average head's skin, the ears as lumps; centimetres.
double head_distance(const Eigen::Vector3d& p);
Eigen::Vector3d away_from_head(const Eigen::Vector3d& p);

// The large form of hair of one cut on the average head. Points are on or near its scalp, centimetres.
/// Centimetres from the edge of where hair grows, inwards.
double hair_within(const HairCut& cut, const Eigen::Vector3d& p);
/// How far all of the hair stands off the scalp; flat at its edges and where it is parted.
double hair_stand_off(const HairCut& cut, const Eigen::Vector3d& p);
/// Which way it is combed, a unit vector along the scalp.
Eigen::Vector3d combed_way(const HairCut& cut, const Eigen::Vector3d& p);

/// Hair in the making: quads at whose corners texture coordinates are the vertices' own.
struct HairMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> uvs;  ///< #points
  Topology topology;

  /// Of at least one point.
  Mesh finished() &&;
};

/// Adds what lies below the cards, so that nobody sees between them: the scalp where hair grows, lifted to where it
/// stands. Shows the last strip of hair_picture, with tips at the edge.
void add_hair_cap(const HairCut& cut, HairMesh& hair);

}  // namespace crowdface::synth
