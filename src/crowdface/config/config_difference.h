// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace crowdface {

/// Compares the config.yaml of a crowd with the config of a run; ignores comments, layout and the
/// key `review`. A key that is missing from the old config counts as its default, because an older
/// version that did not know the key may have written that config.
/// \param old_text  the crowd's config.yaml.
/// \param text      the config of the run.
/// \return the first differing key, such as "sampling.age"; nothing if the configs are equivalent.
std::optional<std::string> config_difference(const std::string& old_text, const std::string& text);

}  // namespace crowdface
