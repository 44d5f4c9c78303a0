// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// Compares the config.yaml of a crowd with the config of a run. Ignores comments, layout, the keys
/// on which no recipe depends (Key::after_casting), and a larger `crowd.count`, unless
/// `diversity.mode` is `spread`. A key that is missing from the old config counts as its default,
/// because an older version that did not know the key may have written that config.
/// \param old_text  the crowd's config.yaml.
/// \param text      the config of the run.
/// \return the keys that decide who the faces are and differ, such as "sampling.age"; none if both
///         configs give the same faces.
std::vector<std::string> config_differences(const std::string& old_text, const std::string& text);

/// Returns the whole number at a key of a config, such as "crowd.count"; nothing if there is none.
std::optional<std::uint64_t> number_in_config(const std::string& text, std::string_view key_path);

}  // namespace crowdface
