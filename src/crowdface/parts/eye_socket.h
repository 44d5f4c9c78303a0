// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/ball_map.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// The skin close to the front of an eyeball: the lids and their lining. The rim is the subset that
/// contains, in each of several directions around the eye's axis, the vertex nearest to the axis.
struct Lids {
  std::vector<std::uint32_t> vertices;  ///< ascending
  std::vector<std::uint32_t> rim;       ///< indices into `vertices`, ascending
  std::vector<bool> is_upper;           ///< #rim: whether the vertex belongs to the upper lid
};

/// Finds the lids of an eyeball.
///
/// \param eyeball  Vertices of the eyeball.
/// \param centre   Centre of the eyeball.
/// \param radius   Radius of the eyeball.
/// \param skin     The skin's vertices.
Lids find_lids(const Positions& positions, const PointGrid& eyeball, const Eigen::Vector3d& centre,
               double radius, const HeadAxes& axes, std::span<const std::uint32_t> skin);

/// Fits an eyeball behind the lids of a face, in the same position as in the heads.
class EyeSocket {
 public:
  EyeSocket() = default;
  /// \param maps  #heads: the radii of the eyeball in each head.
  EyeSocket(Lids lids, std::vector<BallMap> maps, const std::vector<Head>& heads);

  const Lids& lids() const { return lids_; }
  /// Returns, for each rim vertex, the gap between this vertex and the eyeball in a head; negative
  /// if the vertex is inside the eyeball.
  const std::vector<double>& gaps(std::size_t head) const { return gaps_[head]; }

  /// Fits the eyeball of `target` behind the lids of a face. Translates the eyeball and scales it
  /// slightly, so that the mean gap to each lid equals the gap on the target, and the gaps at the
  /// rim are as near as possible to the target's gaps. No lid vertex is deeper inside the eyeball
  /// than in the head where this vertex is deepest. A lid vertex that is outside in all heads stays
  /// outside.
  ///
  /// \param motion  Motion of the skin around the eye.
  /// \param after   The face with the moved skin.
  RigidMotion fit(std::size_t target, const RigidMotion& motion, const Positions& after) const;
  /// Fits an eyeball of given size by translation only.
  ///
  /// \param fitted  Result of `fit`, scaled to the wanted size.
  RigidMotion fit_translation(std::size_t target, const RigidMotion& motion,
                              const RigidMotion& fitted, const Positions& after) const;
  Eigen::Vector3d centre(std::size_t target) const { return maps_[target].centre(); }

 private:
  enum class SizeMode { kFree, kKept };
  struct LidPoint {
    Eigen::Vector3d point;
    std::uint32_t index;
  };
  /// Returns `motion` improved by one step of the optimisation.
  /// \param far  The function removes lid points that are farther away than this fraction of the
  ///             radius.
  RigidMotion step(std::size_t target, const RigidMotion& start, const RigidMotion& motion,
                   double far, SizeMode size_mode, std::vector<LidPoint>& lids) const;
  RigidMotion iterate_steps(std::size_t target, const RigidMotion& start, RigidMotion fitted,
                            SizeMode size_mode, const Positions& after) const;

  Lids lids_;
  std::vector<BallMap> maps_;               ///< #heads
  std::vector<std::vector<double>> gaps_;   ///< #heads by #rim
  std::vector<double> smallest_gaps_;       ///< #lids: smallest gap in all heads
  std::vector<std::uint32_t> rim_indices_;  ///< #lids: index in the rim, or kNoIndex
};

}  // namespace crowdface
