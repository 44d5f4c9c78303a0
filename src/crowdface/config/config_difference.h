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
/// keys on which no recipe depends (Key::ignored_by_recipes). Unless `diversity.mode` is `spread`,
/// also ignores a larger `crowd.count`, and smallest distances of faces that the crowd does not
/// have. A key that is missing from the old config counts as its default, because an older version
/// that did not know the key may have written that config.
/// \param old_text  the crowd's config.yaml.
/// \param text      the config of the run.
/// \return the keys that decide who the faces are and differ, such as "sampling.age"; none if both
///         configs give the same faces.
std::vector<std::string> config_differences(const std::string& old_text, const std::string& text);

/// Returns the whole number at a key of a config, such as "crowd.count"; nothing if there is none.
std::optional<std::uint64_t> number_in_config(const std::string& text, std::string_view key_path);

/// The smallest distances that a config requires between the faces of a crowd.
struct KeptDistances {
  double min_distance_mm = 0;
  std::map<std::uint64_t, double>
      min_distance_of_first_mm;  ///< DiversityOptions::min_distance_of_first_mm
};

/// Returns the smallest distances in a config.yaml; nothing if they cannot be read, or if
/// `diversity.mode` is `spread`.
std::optional<KeptDistances> distances_in_config(const std::string& text);

}  // namespace crowdface
