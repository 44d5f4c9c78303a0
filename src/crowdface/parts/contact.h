// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/rigid_motion.h"
#include "crowdface/parts/surface_point.h"

namespace crowdface {

/// Where a rigid part lies so near to the skin that it may come to pass through it: teeth behind lips
/// and cheeks. Pairs of a vertex of the part and a triangle of the skin.
class Contact {
 public:
  Contact() = default;
  /// \param positions  of the head on which the pairs are looked for
  /// \param reach      how near
  Contact(const Topology& topology, const FacesAround& faces, const Positions& positions,
          const PointGrid& skin, std::span<const std::uint32_t> part, double reach);

  /// How far the part's vertices are off the skin in one head, #pairs; negative: through it.
  std::vector<double> heights(const Positions& head) const;

  /// The shortest shift, about, that clears the part of the skin where it passes through it farther
  /// than in the target.
  /// \param before   heights of the target
  /// \param margin   what is left of a clearance that the target has
  Eigen::Vector3d clearing_shift(const Positions& target, std::span<const double> before,
                                 const RigidMotion& motion, const Positions& after,
                                 double margin) const;

  std::size_t size() const { return pairs_.size(); }

 private:
  struct Pair {
    std::uint32_t vertex;
    std::array<std::uint32_t, 3> corners;
    std::array<double, 3> shares;
  };
  Eigen::Vector3d normal(const Pair& pair, const Positions& head) const;
  double height(const Pair& pair, const Eigen::Vector3d& point, const Positions& skin) const;

  std::vector<Pair> pairs_;
  double side_ = 1;  ///< −1: the skin's faces look away from the part
};

}  // namespace crowdface
