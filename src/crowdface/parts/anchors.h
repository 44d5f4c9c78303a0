// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/point_grid.h"
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
  struct Site {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t begin = 0, end = 0;  ///< of its ring in ring_
  };
  struct RingVertex {
    std::uint32_t vertex;
    double along, across;  ///< weights in the two moments
  };

  Frame frame_at(const Site& site, const Positions& positions) const;
  Eigen::Vector3d origin(std::size_t i, const Positions& positions) const;
  bool unmoved(const Site& site, const Positions& before, const Positions& after) const;

  std::vector<std::uint32_t> bound_;           ///< ascending
  std::vector<std::uint32_t> site_of_;         ///< #bound
  std::vector<std::array<double, 3>> shares_;  ///< #bound, barycentric
  std::vector<Site> sites_;
  std::vector<RingVertex> ring_;
};

}  // namespace crowdface
