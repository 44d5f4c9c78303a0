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
  /// \param grid       of the skin at these positions
  /// \param reach      how near
  /// Topology and faces must outlive it.
  Contact(const Topology& topology, const FacesAround& faces, const Positions& positions,
          const PointGrid& grid, std::span<const std::uint32_t> skin,
          std::span<const std::uint32_t> part, double reach, const std::vector<Head>& heads);

  /// How far a pair's vertex, wherever it is, is off the skin of a head; negative: through it.
  struct Height {
    double height = 0;
    Eigen::Vector3d outward;  ///< off the skin, unit
  };
  Height height(std::size_t pair, const Eigen::Vector3d& point, const Positions& skin) const;

  /// A motion as near as can be to the given one after which no vertex is deeper in the skin than in
  /// any of the heads, nor in it at all if it is in none. The part is shifted, turned and made a little
  /// smaller.
  /// \param target  the part before the motion
  /// \param margin  what is left of a clearance that all heads have
  RigidMotion clear(const Positions& target, const RigidMotion& motion, const Positions& after,
                    double margin) const;

  std::size_t size() const { return pairs_.size(); }

 private:
  static constexpr std::size_t kStarts = 3;
  using Starts = std::array<std::uint32_t, kStarts>;
  struct Pair {
    std::uint32_t vertex;
    Triangle corners;
    std::array<double, 3> shares;
    /// Vertices to start from when the nearest skin is looked for: of both lips, where both are near.
    Starts starts;
    double least;  ///< height in all heads
  };
  /// Pairs close together, and by how much one of them may be farther off the skin than another is.
  struct Cluster {
    std::size_t begin, end;  ///< of pairs_; the one that stands for all is in the middle
    double slack;
    std::size_t middle() const { return begin + (end - begin) / 2; }
  };
  void find_starts(const Positions& positions, std::span<const std::uint32_t> skin,
                   const std::vector<Head>& heads);
  void find_clusters(const Positions& positions, const std::vector<Head>& heads);
  double rough_height(const Pair& pair, const Eigen::Vector3d& point, const Positions& skin) const;
  Eigen::Vector3d normal_near(const SurfacePoint& place, const Positions& skin) const;
  /// \param near  the pairs to look at; those that turn out to be far are taken out
  /// \return false if nothing is missing
  bool step(const Positions& target, const RigidMotion& start, const Positions& after,
            double margin, std::vector<std::uint32_t>& near, RigidMotion& motion) const;

  const Topology* topology_ = nullptr;
  const FacesAround* faces_ = nullptr;
  double reach_ = 0;
  double side_ = 1;    ///< −1: the skin's faces look away from the part
  double radius_ = 0;  ///< of the part: root mean square about its middle
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();  ///< of the part where the pairs were found
  std::vector<Pair> pairs_;                           ///< by cluster
  std::vector<Cluster> clusters_;
};

}  // namespace crowdface
