// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace crowdface {

/// Where a crowd's config.yaml differs from the one of a run, whatever comments and layout. A key that the crowd's config
/// lacks has its default there: an older version, which did not know the key, wrote that config.
/// \return the first key, such as "sampling.age"; nothing if both are of the same crowd, which further
///         reviews are allowed to have changed: the old ones first, in their order.
std::optional<std::string> config_difference(const std::string& old_text, const std::string& text);

}  // namespace crowdface
