// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "crowdface/mesh/mirror_map.h"
#include "crowdface/paint/surface_distance.h"
#include "crowdface/region/region_weights.h"

namespace crowdface {

enum class BrushMode : std::uint8_t {
  kAdd,     ///< more of the region
  kErase,   ///< less of it: the others grow in proportion
  kSmooth,  ///< all regions run more softly into one another
  kGrow,    ///< the region's border moves outwards
};

struct Brush {
  BrushMode mode = BrushMode::kAdd;
  double radius = 1;    ///< along the surface, in the positions' unit, above 0
  double strength = 1;  ///< 0 to 1: how much is changed where the brush is strongest
  double falloff = 1;   ///< 0: equally strong up to the rim; 1: softer from the middle on
  bool mirror = false;  ///< paints on the other half of the head too
};

/// Regions of a mesh that are painted by hand. Whatever is done to them, weights are not negative and sum
/// to one at every vertex, and all can be taken back exactly.
class MaskPainter {
 public:
  using Alpha = RegionWeights::Alpha;

  /// \param positions  #V by 3, of the head that is painted on; with the topology they must outlive it.
  /// \param mirror     where the head's halves meet.
  /// \param alpha      #V by #R.
  MaskPainter(const Topology& topology, const Positions& positions, const MirrorPlane& mirror,
              Alpha alpha);

  const Alpha& alpha() const { return alpha_; }
  const SurfaceDistance& surface() const { return surface_; }

  /// One touch of the brush along some places: as strong at a vertex as where it comes nearest.
  /// \param goes_on  whether it belongs to the touch before, and is taken back with that.
  /// \return the vertices that may have changed, ascending.
  /// \throws BrokenPrecondition for numbers outside their ranges.
  std::vector<std::uint32_t> paint(Index region, const std::vector<SurfacePoint>& places,
                                   const Brush& brush, bool goes_on = false);

  /// The weights if there were no such region: its share goes to the others in proportion; where it was
  /// alone, to those around, and failing these to the first.
  /// \throws BrokenPrecondition if it is the only one.
  Alpha alpha_without(Index region) const;

  bool can_undo() const { return !done_.empty(); }
  /// Takes the last step back. \return false if there is none.
  bool undo();

 private:
  /// What stood there before a step: rows of α by vertex.
  using Step = std::map<std::uint32_t, Eigen::RowVectorXd>;

  MirrorPlane mirror_;
  SurfaceDistance surface_;
  Alpha alpha_;
  std::vector<Step> done_;
};

}  // namespace crowdface
