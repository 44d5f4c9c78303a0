// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "crowdface/mesh/mirror_map.h"
#include "crowdface/paint/face_landmarks.h"
#include "crowdface/pick/pickable_mesh.h"
#include "crowdface/wrap/report.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// Finds the landmarks of a template's face by the shape of the surface.
/// \return no points if no face is found.
FaceLandmarks find_face_landmarks(const WrapTemplate& wrap_template);

/// Finds the landmarks of a template's face as find_face_landmarks does.
/// \return for each name of a landmark: the nearest vertex of the template
std::map<std::string, std::uint32_t> propose_landmarks(const WrapTemplate& wrap_template);

/// A mesh of the template whose skin can be picked and whose eyes and teeth occlude the skin.
/// \param positions  #V by 3
PickableMesh make_pickable(const WrapTemplate& wrap_template, const Positions& positions);

/// Regions of the skin: brow, nose and mouth; also ears and neck, if these are found. Empty if no
/// face is found.
SkinRegions face_regions(const WrapTemplate& wrap_template);

/// The symmetry plane between the left and right half of a template.
MirrorPlane symmetry_plane(const WrapTemplate& wrap_template, const Positions& positions);

}  // namespace crowdface
