// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "crowdface/mesh/mirror_map.h"
#include "crowdface/paint/surface_distance.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {

/// What the brush does to the weights of the painted region.
enum class BrushMode : std::uint8_t {
  kAdd,  ///< increases the weight of the painted region
  /// decreases the weight of the painted region; the other regions' weights grow in proportion
  kErase,
  kSmooth,  ///< smooths the weights of all regions
  kGrow,    ///< moves the border of the painted region outwards
};

/// Settings of the brush with which the user paints weights.
struct Brush {
  BrushMode mode = BrushMode::kAdd;
  /// radius of the brush along the surface, in the unit of the positions, above 0
  double radius = 1;
  double strength = 1;  ///< strength at the brush's centre, from 0 (no change) to 1
  /// 0: constant strength from the centre to the rim; 1: the strength decreases all the way from
  /// the centre to the rim
  double falloff = 1;
  /// whether each stroke also paints its mirror image on the other half of the head
  bool paints_mirror_image = false;
};

/// Regions of a mesh that the user paints by hand. At every vertex the weights are not negative and
/// sum to one. Each undo restores exactly the weights before the last stroke.
class MaskPainter {
 public:
  using Alpha = RegionWeights::Alpha;

  /// \param positions  #V by 3, the head on which the user paints. Topology and positions must
  ///                   outlive this object.
  /// \param mirror     symmetry plane of the head.
  /// \param alpha      #V by #regions: the weights at the start.
  MaskPainter(const Topology& topology, const Positions& positions, const MirrorPlane& mirror,
              Alpha alpha);

  /// Returns the current weights, #V by #regions.
  const Alpha& alpha() const { return alpha_; }
  const SurfaceDistance& surface() const { return surface_; }

  /// Applies the brush at several points of the surface. Where the discs of the brush overlap, the
  /// largest strength applies.
  /// \param continues_stroke  whether this call continues the stroke of the previous call, so that
  ///                          one undo reverts both calls.
  /// \return the vertices that may have changed, ascending.
  /// \throws BrokenPrecondition for numbers outside their ranges.
  std::vector<std::uint32_t> paint(Index region, const std::vector<SurfacePoint>& points,
                                   const Brush& brush, bool continues_stroke = false);

  /// The weights after removal of a region, #V by #regions − 1. At each vertex, the weight of the
  /// removed region goes to the vertex's other regions in proportion to their weights. A vertex
  /// without other regions gets the mean weights of its neighbours. If no path along edges leads to
  /// a vertex with other regions, the vertex gets the weight 1 of the first remaining region.
  /// \throws BrokenPrecondition if there is no other region.
  Alpha alpha_without(Index region) const;

  bool can_undo() const { return !undo_steps_.empty(); }
  /// Undoes the last stroke.
  /// \return false if there is no stroke to undo.
  bool undo();

 private:
  /// The weights before a stroke: for each vertex that the stroke changed, its row of `alpha_`.
  using Step = std::map<std::uint32_t, Eigen::RowVectorXd>;

  MirrorPlane mirror_;
  SurfaceDistance surface_;
  Alpha alpha_;
  /// for each stroke that can be undone: the weights before the stroke
  std::vector<Step> undo_steps_;
};

}  // namespace crowdface
