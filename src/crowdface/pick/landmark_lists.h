// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/pick/landmark_place.h"

namespace crowdface {

/// The extensions of the files that read_landmarks reads.
const std::vector<std::string>& landmark_extensions();

/// Reads a file of another program that lists landmarks of one mesh: MeshLab's picked points (.pp),
/// tables of names and numbers (CSV, text), JSON ({name: [x, y, z]}, lists of points, 3D Slicer
/// markups), NumPy arrays (n by 3 points, or n vertex numbers), and the formats of
/// parse_morphometric_list. A point without a name gets its position in the list, from 1, as its
/// name. Texts may have any encoding that decoded_text reads. Converts points of 3D Slicer to the
/// axes left, posterior, superior, which Slicer's mesh files have. Skips points that the user of
/// the other program has not placed.
/// \return nothing if the file has the form that read_landmarks reads (keys `template` and `scan`)
///         or if its format is unknown.
/// \throws UsageError that names the location of the error in the file.
std::optional<std::map<std::string, LandmarkPlace>> parse_landmark_list(
    std::string_view bytes, const std::filesystem::path& path);

}  // namespace crowdface
