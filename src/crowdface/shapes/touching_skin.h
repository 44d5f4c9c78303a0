// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/mesh/displacements.h"
#include "crowdface/mesh/triangles.h"

namespace crowdface {

/// The triangles of a mesh whose corners are all skin.
struct SkinTriangles {
  std::vector<std::uint32_t> vertices;  ///< vertex indices of the skin, ascending
  std::vector<Triangle> triangles;
  CompressedRows<std::uint32_t> vertex_triangles;  ///< triangles at each vertex
};

/// Returns, for each vertex, whether a shape folds the skin there, or brings it so near to other
/// skin that both may touch on some face.
///
/// \param neutral  Template at rest, #V by 3.
/// \param shaped   Positions of the template's vertices with the shape applied, #V by 3.
/// \param extent   Diagonal of the skin's bounding box.
std::vector<bool> skin_that_may_touch(const SkinTriangles& skin, const Positions& neutral,
                                      const Positions& shaped, double extent);

}  // namespace crowdface
