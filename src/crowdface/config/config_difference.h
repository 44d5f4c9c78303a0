// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// Compares the config.yaml of a crowd with the config of a run. Ignores comments, layout and the
/// keys on which no recipe depends (Key::not_affecting_recipes). Unless `diversity.mode` is
/// `spread`, two more differences are ignored: a larger `crowd.count`, and required distances
/// (`diversity.min_distance`, `diversity.min_distance_of_first`) that differ only for faces after
/// the last face of the old crowd. If a key is missing in the old config, its default is
/// compared, because an older version that did not know the key may have written that config.
///
/// \param old_text  the crowd's config.yaml.
/// \param text      the config of the run.
/// \return the keys that differ and decide which faces the crowd has, such as "sampling.age"; none
///         if both configs give the same faces.
std::vector<std::string> config_differences(const std::string& old_text, const std::string& text);

/// Returns the whole number that a key of a config has, such as "crowd.count". Returns nothing if
/// the key is missing or has no whole number.
std::optional<std::uint64_t> number_in_config(const std::string& text, std::string_view key_path);

/// The smallest distances that a config requires between the faces of a crowd.
struct RequiredDistances {
  double min_distance_mm = 0;  ///< smallest allowed distance between two faces
  /// Values that replace `min_distance_mm` for the first faces of the crowd. Each key is the number
  /// of the last face to which the value applies; see
  /// DiversityOptions::min_distance_mm_up_to_face.
  std::map<std::uint64_t, double> min_distance_mm_up_to_face;
};

/// Returns the smallest distances that a config.yaml requires. Returns nothing if the distances
/// cannot be read, or if `diversity.mode` is `spread`.
std::optional<RequiredDistances> distances_in_config(const std::string& text);

}  // namespace crowdface
