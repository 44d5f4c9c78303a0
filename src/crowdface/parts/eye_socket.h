// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/parts/ball_radii.h"
#include "crowdface/parts/head_axes.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/rigid_motion.h"

namespace crowdface {

/// The skin close to the front of an eyeball: the lids and their lining. In each of several
/// directions around the eye's axis, the vertex nearest to the axis belongs to the rim.
struct Lids {
  std::vector<std::uint32_t> vertices;  ///< vertex indices of the mesh, ascending
  std::vector<std::uint32_t> rim;       ///< the rim vertices, as ascending indices into `vertices`
  std::vector<bool> is_upper;  ///< for each entry of `rim`: whether it belongs to the upper lid
};

/// Finds the lids of an eyeball.
///
/// \param eyeball  Vertices of the eyeball.
/// \param centre   Centre of the eyeball.
/// \param radius   Radius of the eyeball.
/// \param skin     The skin's vertices.
Lids find_lids(const Positions& positions, const PointGrid& eyeball, const Eigen::Vector3d& centre,
               double radius, const HeadAxes& axes, std::span<const std::uint32_t> skin);

/// Fits an eyeball behind the lids of a face, with nearly the same gaps to the lids as on the
/// target.
class EyeSocket {
 public:
  EyeSocket() = default;
  /// \param ball_radii  The radii of the eyeball in each head, by direction.
  EyeSocket(Lids lids, std::vector<BallRadii> ball_radii, const std::vector<Head>& heads);

  const Lids& lids() const { return lids_; }
  /// Returns, for each rim vertex, the gap between this vertex and the eyeball in a head; negative
  /// if the vertex is inside the eyeball.
  const std::vector<double>& gaps(std::size_t head) const { return gaps_[head]; }

  /// Fits the eyeball of a head behind the lids of a face that is built on this head. Translates
  /// the eyeball and scales it slightly, so that the mean gap to each lid is the same as on the
  /// head, and the gaps at the rim are nearly the same. No lid vertex gets deeper inside the
  /// eyeball than its largest depth in any head. A lid vertex that is outside the eyeball in all
  /// heads stays outside.
  ///
  /// \param target       Index of the head.
  /// \param skin_motion  Motion of the skin around the eye, from the head to the face.
  /// \param face         The face, with the moved skin.
  /// \return             Motion of the eyeball from the head to the face, including its scaling.
  RigidMotion fit(std::size_t target, const RigidMotion& skin_motion, const Positions& face) const;
  /// Improves only the translation of an eyeball's motion and keeps its scale, because the caller
  /// gives the size of the eyeball.
  ///
  /// \param scaled_motion  Result of `fit`, scaled to the wanted size.
  RigidMotion fit_translation(std::size_t target, const RigidMotion& skin_motion,
                              const RigidMotion& scaled_motion, const Positions& face) const;
  /// Returns the centre of the eyeball in the head with the index `target`.
  Eigen::Vector3d centre(std::size_t target) const { return ball_radii_[target].centre(); }

 private:
  /// Whether the optimisation may change the size of the eyeball.
  enum class SizeMode { kFree, kKept };
  /// A vertex of a lid, and its position in a new head ("face").
  struct LidPoint {
    Eigen::Vector3d point;  ///< position of the vertex
    std::uint32_t index;    ///< index into `Lids::vertices`
  };
  /// Returns the motion of the eyeball improved by one step of the optimisation.
  /// \param target       Index of the head whose eyeball is moved.
  /// \param skin_motion  Motion of the skin around the eye, from this head to the face.
  /// \param motion       Motion of the eyeball before the step, from this head to the face.
  /// \param far          The function removes from `lids` the points whose distance from the
  ///                     eyeball is larger than this fraction of the eyeball's radius.
  /// \param lids         The lid vertices to check.
  RigidMotion step(std::size_t target, const RigidMotion& skin_motion, const RigidMotion& motion,
                   double far, SizeMode size_mode, std::vector<LidPoint>& lids) const;
  /// Repeats `step` until the eyeball hardly moves; starts from `motion`.
  RigidMotion iterate_steps(std::size_t target, const RigidMotion& skin_motion, RigidMotion motion,
                            SizeMode size_mode, const Positions& face) const;

  Lids lids_;
  std::vector<BallRadii> ball_radii_;      ///< for each head: the radii of the eyeball in the head
  std::vector<std::vector<double>> gaps_;  ///< for each head: the result of gaps()
  std::vector<double> smallest_gaps_;      ///< for each lid vertex: its smallest gap in all heads
  /// for each lid vertex: its index in Lids::rim; kNoIndex if the vertex is not on the rim
  std::vector<std::uint32_t> rim_indices_;
};

}  // namespace crowdface
