// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// A skin with fewer vertices that replaces a large one during deformation.
struct ReducedSkin {
  SkinMesh mesh;  ///< its `vertices` are rows of the large skin
  /// Position of a vertex of the large skin on the small one: triangle and barycentric coordinates.
  struct Place {
    std::uint32_t triangle;
    std::array<float, 3> shares;
  };
  std::vector<Place> places;  ///< #large
  int smoothings = 0;         ///< number of smoothing steps after interpolation

  /// Interpolates values from the small skin's vertices (#small by 3) to those of the large skin,
  /// and smooths them so that the small skin's edges do not show.
  Positions carry(const Positions& values, const SkinMesh& large) const;
  /// Interpolates one value per vertex, without smoothing.
  std::vector<double> carry(const std::vector<double>& values) const;
};

/// Reduces a skin to about `vertices` vertices, a subset of its own.
/// \param positions  #skin by 3
ReducedSkin reduce_skin(const SkinMesh& skin, const Positions& positions, std::size_t vertices);

}  // namespace crowdface
