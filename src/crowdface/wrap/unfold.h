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

/// Turns folded triangles back: a patch around them becomes as rigid as it can be against the
/// template, a few rings at first and more where that is not enough, until nothing is folded.
/// \return how many triangles are still folded.
Index unfold(const SkinMesh& skin, const Positions& rest, Positions& positions);

}  // namespace crowdface
