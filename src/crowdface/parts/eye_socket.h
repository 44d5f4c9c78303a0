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

/// The skin close to the front of an eyeball: lids and what lines them. Of these the rim: in each of
/// some directions around the axis, the vertex that comes nearest to the axis.
struct Lids {
  std::vector<std::uint32_t> vertices;  ///< ascending
  std::vector<std::uint32_t> rim;       ///< places in `vertices`, ascending
  std::vector<bool> upper;              ///< #rim: of the upper lid
};

/// \param eyeball         vertices of the eyeball
/// \param centre, radius  of the eyeball
/// \param skin            the skin's vertices
Lids find_lids(const Positions& positions, const PointGrid& eyeball, const Eigen::Vector3d& centre,
               double radius, const HeadAxes& axes, std::span<const std::uint32_t> skin);

/// How an eyeball lies behind its lids in each of the heads, and how it is put there in a new one.
class EyeSocket {
 public:
  EyeSocket() = default;
  /// \param maps   of the eyeball in each head
  EyeSocket(Lids lids, std::vector<BallMap> maps, const std::vector<Head>& heads);

  const Lids& lids() const { return lids_; }
  /// Of the rim in one of the heads; negative inside the eyeball.
  const std::vector<double>& gaps(std::size_t head) const { return gaps_[head]; }

  /// Where the eyeball of `target` comes to lie when its face has moved: shifted, and made a little
  /// smaller or larger, so that its mean gap to each lid becomes what it was, and each gap of the rim as
  /// nearly as it then can, while no lid enters it farther than in any of the heads, nor at all if it
  /// enters it in none.
  /// \param motion  of the skin around the eye
  RigidMotion fit(std::size_t target, const RigidMotion& motion, const Positions& after) const;
  /// The same by a shift alone. \param fitted  as `fit` gives it, of the size that the eyeball is to have
  RigidMotion fit_of_size(std::size_t target, const RigidMotion& motion, const RigidMotion& fitted,
                          const Positions& after) const;
  Eigen::Vector3d centre(std::size_t target) const { return maps_[target].centre(); }

 private:
  enum class Size { kFree, kKept };
  struct Lid {
    Eigen::Vector3d point;
    std::uint32_t number;
  };
  /// \param far  lids farther off than this share of the radius are taken out
  RigidMotion step(std::size_t target, const RigidMotion& start, const RigidMotion& motion,
                   double far, Size size, std::vector<Lid>& lids) const;
  RigidMotion steps(std::size_t target, const RigidMotion& start, RigidMotion fitted, Size size,
                    const Positions& after) const;

  Lids lids_;
  std::vector<BallMap> maps_;              ///< #heads
  std::vector<std::vector<double>> gaps_;  ///< #heads by #rim
  std::vector<double> least_;              ///< #lids: the least gap of all heads
  std::vector<std::uint32_t> rim_of_;      ///< #lids: number in the rim, or kNoIndex
};

}  // namespace crowdface
