// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "crowdface/mesh/mirror_map.h"
#include "crowdface/pick/pickable_mesh.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// Landmarks of suggested_landmarks that a template's shape tells: along its middle from the outline of the
/// face, corners of eyes and lids from where an eyeball shows.
/// \param mesh  of the template, in millimetres; its skin is the template's, eyes and teeth stand before it
/// \return rows of the template; nothing where no face is found.
std::map<std::string, std::uint32_t> propose_landmarks(const WrapTemplate& shape,
                                                       const PickableMesh& mesh);

/// The skin of a head, with its eyes and teeth before it. \param positions  #V by 3
PickableMesh pickable(const WrapTemplate& shape, const Positions& positions);

/// Brow, nose and mouth, and ears and neck where they are found; nothing where no face is.
SkinRegions face_regions(const WrapTemplate& shape);

/// The plane between a template's halves.
MirrorPlane middle_plane(const WrapTemplate& shape, const Positions& positions);

}  // namespace crowdface
