// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/wrap/skin_mesh.h"

namespace crowdface {

/// The triangles of a wrapped skin that are turned by more than a right angle against the template's,
/// or have hardly any of their area left.
/// \param rest      #skin by 3, the template's own.
/// \param positions #skin by 3, wrapped.
std::vector<std::uint32_t> folded_triangles(const SkinMesh& skin, const Positions& rest,
                                            const Positions& positions);

/// Turns folded triangles back: around each the smallest patch that mends it is laid as the template is, by the
/// similarity that carries the template's patch there, less and less towards the patch's rim.
/// \return how many triangles are still folded.
Index unfold(const SkinMesh& skin, const Positions& rest, Positions& positions);

}  // namespace crowdface
