// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// The triangles of a wrapped skin that are turned over: their normals look against those of the
/// surface around them where the template's do not, or they have a fiftieth of their size left.
/// \param rest      #skin by 3, the template's own.
/// \param positions #skin by 3, wrapped.
std::vector<std::uint32_t> folded_triangles(const SkinMesh& skin, const Positions& rest,
                                            const Positions& positions);

/// Turns folded triangles back: around them the displacements are evened out, in a patch that grows
/// until nothing is folded that is not folded in the template itself.
/// \return how many triangles are still folded: 0 but for templates that no displacement could mend.
Index unfold(const SkinMesh& skin, const Positions& rest, Positions& positions);

}  // namespace crowdface
