// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// A place of a face that is found again on any other. Left and right are the head's own.
struct LandmarkName {
  std::string_view name;
  std::string_view where;  ///< said to whoever picks it
};

/// Names to begin with, in the order in which to pick them: the first four tell how a head stands.
const std::vector<LandmarkName>& suggested_landmarks();

/// The name of the place on the other half: "eye_outer_left" for "eye_outer_right", "brow_l" for "brow_r";
/// nothing if it speaks of neither.
std::optional<std::string> mirrored_name(std::string_view name);

}  // namespace crowdface
