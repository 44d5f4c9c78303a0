// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "crowdface/pick/landmark_place.h"

namespace crowdface {

/// Landmarks as other programs write them, of one mesh: MeshLab's picked points (.pp), lists of names and numbers
/// (CSV, text), JSON ({name: [x, y, z]}, lists of points, 3D Slicer's markups), NumPy's arrays (n by 3, or n vertices).
/// Points without names are called by their numbers, from 1.
/// \return nothing if the file is YAML, or JSON of the same form: template and scan.
/// \throws UsageError naming the place that is wrong.
std::optional<std::map<std::string, LandmarkPlace>> parse_landmark_list(
    std::string_view bytes, const std::filesystem::path& path);

}  // namespace crowdface
