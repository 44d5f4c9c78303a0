// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// A skin of fewer vertices that stands for a large one while it is bent.
struct ReducedSkin {
  SkinMesh mesh;  ///< its `vertices` are rows of the large skin
  /// Where each vertex of the large skin lies on the small one.
  struct Place {
    std::uint32_t triangle;
    std::array<float, 3> shares;
  };
  std::vector<Place> places;  ///< #large
  int smoothings = 0;         ///< that even out what is carried up

  /// Values of the small skin's vertices (#small by 3) between which those of the large one's lie, and
  /// evened out so that the edges of the small one do not show.
  Positions carry(const Positions& values, const SkinMesh& large) const;
  /// The same of one value a vertex, not evened out.
  std::vector<double> carry(const std::vector<double>& values) const;
};

/// Reduces a skin to about so many vertices, which are some of its own.
/// \param positions  #skin by 3
ReducedSkin reduce_skin(const SkinMesh& skin, const Positions& positions, std::size_t vertices);

}  // namespace crowdface
