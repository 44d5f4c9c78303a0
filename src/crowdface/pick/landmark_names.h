// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// A point that can be located on every face. Left and right are the head's own left and right.
struct LandmarkDefinition {
  std::string_view name;
  std::string_view location;  ///< describes to the user where the landmark lies on a face
  /// Whether find_landmarks searches for the landmark on scans. Only landmarks on edges or grooves
  /// of the skin can be found precisely; the widest point of a nose, for example, cannot.
  bool is_found_on_scans = false;
};

/// Standard landmarks, in the order in which users should pick them; then the remaining landmarks
/// that measurements need (trait_landmarks). The first four landmarks determine the pose of a head.
const std::vector<LandmarkDefinition>& suggested_landmarks();

/// The name of the landmark on the other side: "eye_outer_left" for "eye_outer_right", "brow_l" for
/// "brow_r"; nothing if the name has no side.
std::optional<std::string> mirrored_name(std::string_view name);

}  // namespace crowdface
