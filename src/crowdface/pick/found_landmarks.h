// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/scan.h"
#include "crowdface/wrap/wrap.h"

namespace crowdface {

/// Finds landmarks on a scan by the shape of the surface: the landmarks of nose, lips and chin on
/// the midline of the face and, if the scan has eyeballs, the corners of the eyes and the edges of
/// the lids. Omits landmarks whose positions do not fit the template's landmarks. Returns no
/// landmarks if no face is found.
/// \param template_vertices  landmarks of the template by name, as vertex numbers (see
///                           propose_landmarks)
/// \param hint  up and front directions of the scan
std::vector<WrapLandmark> find_landmarks(
    const WrapTemplate& wrap_template,
    const std::map<std::string, std::uint32_t>& template_vertices, const Scan& scan,
    const PoseHint& hint);

}  // namespace crowdface
