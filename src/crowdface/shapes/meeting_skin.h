// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// The skin of a mesh, as triangles among its vertices.
struct SkinTriangles {
  std::vector<std::uint32_t> vertices;  ///< ascending
  std::vector<Triangle> triangles;
  Grouped<std::uint32_t> around;  ///< #V: triangles at each vertex
};

/// Skin that a shape folds, brings to other skin, or may on another face bring to other skin; #V.
/// \param neutral  of the template, #V by 3
/// \param shaped   the template in the shape
/// \param extent   of the skin
std::vector<bool> skin_that_may_meet(const SkinTriangles& skin, const Positions& neutral,
                                     const Positions& shaped, double extent);

}  // namespace crowdface
