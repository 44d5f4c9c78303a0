// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// Returns the indices of the triangles of a wrapped skin that are rotated by more than a right
/// angle relative to the template, or that have lost nearly all their area.
/// \param rest_positions  positions of the skin's vertices on the template, one row for each.
/// \param positions       positions of the same vertices after the wrap.
std::vector<std::uint32_t> folded_triangles(const SkinMesh& skin, const Positions& rest_positions,
                                            const Positions& positions);

/// Repairs folded triangles. For each folded triangle, finds the smallest surrounding patch whose
/// repair resolves the fold. The repair blends the patch towards the template's patch after the
/// best similarity fit, with weights that decrease towards the patch's border.
/// \return number of triangles that are still folded.
Index repair_folded_triangles(const SkinMesh& skin, const Positions& rest_positions,
                              Positions& positions);

}  // namespace crowdface
