// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// Where the vertices of bound parts hang on the skin. Each has a place on the nearest triangle of
/// the skin, and a frame of axes that the skin around that triangle turns: two moments of its
/// vertices with fixed weights, made perpendicular.
class Anchors {
 public:
  Anchors() = default;
  /// \param positions  of the head on which the nearest skin is looked for
  /// \param bound      vertices to bind
  Anchors(const Topology& topology, const FacesAround& faces, const Positions& positions,
          const PointGrid& skin, std::vector<std::uint32_t> bound);

  const std::vector<std::uint32_t>& bound() const { return bound_; }

  /// The vertices' places in their frames, #bound.
  std::vector<Eigen::Vector3d> places(const Positions& head) const;
  /// Puts the vertices of `result` at places told by `places` of the target. Where none of the skin
  /// around has moved they get the target's positions to the bit.
  void put(const Positions& target, std::span<const Eigen::Vector3d> places,
           Positions& result) const;

 private:
  using Frame = std::array<Eigen::Vector3d, 3>;  ///< unit axes
  struct RingVertex {
    std::uint32_t vertex;
    double along, across;  ///< weights in the two moments
  };

  Frame frame_at(std::size_t site, const Positions& positions) const;
  Eigen::Vector3d origin(std::size_t i, const Positions& positions) const;
  bool unmoved(std::size_t site, const Positions& before, const Positions& after) const;

  std::vector<std::uint32_t> bound_;           ///< ascending
  std::vector<std::uint32_t> site_of_;         ///< #bound
  std::vector<std::array<double, 3>> shares_;  ///< #bound, barycentric
  std::vector<Triangle> sites_;                ///< on the skin
  Grouped<RingVertex> rings_;                  ///< #sites: the skin around
};

/// What of the bound parts lies at a rigid part and goes along with it: gums with the teeth in them.
class Ties {
 public:
  Ties() = default;
  /// \param positions  of the head on which distances are measured
  /// \param rigid      the vertices of each rigid part that ties
  /// \param bound      vertices that may be tied
  /// \param reach      a vertex this far off is free, one at the part is wholly tied
  Ties(const Positions& positions, const std::vector<std::span<const std::uint32_t>>& rigid,
       std::span<const std::uint32_t> bound, double reach);

  /// Moves the tied vertices of `result` from where they are bound towards where the motions carry
  /// them.
  /// \param motions  #rigid
  void pull(const Positions& target, std::span<const RigidMotion> motions, Positions& result) const;

 private:
  struct Tie {
    std::uint32_t vertex, part;
    double share;  ///< those of a vertex add up to one at most
  };
  std::vector<Tie> ties_;  ///< those of a vertex one after the other
};

}  // namespace crowdface
