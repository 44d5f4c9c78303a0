// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/validity/skin_check.h"
#include "crowdface/validity/triangle_tree.h"

namespace crowdface {

/// Measures how much of the parts that belong behind the skin, such as gums and teeth, protrudes
/// visibly through the skin. Const methods are thread-safe.
class ProtrudingPartsCheck {
 public:
  /// \param parts  indices of the components that are behind the skin
  /// \param mean   a typical head, #V by 3
  ProtrudingPartsCheck(const Topology& topology, const Components& components,
                       std::span<const std::uint32_t> parts, const Positions& mean,
                       ViewSetup view_setup);

  /// Considers the triangles of teeth and other parts. Returns the visible area, in mm², of those
  /// triangles that intersect the skin.
  double exposed_mm2(const Positions& positions) const;

 private:
  /// first the triangles of the skin, then the triangles of the parts
  std::vector<Triangle> triangles_;
  std::uint32_t skin_count_ = 0;  ///< number of triangles of the skin
  TriangleTree tree_;             ///< tree of `triangles_`
  ViewSetup view_setup_;  ///< the viewers for which the visible area of the parts is measured
};

}  // namespace crowdface
