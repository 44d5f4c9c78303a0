// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {

/// Thrown if a caller broke a documented precondition. This means a bug in crowdface, not a mistake
/// of the user. Exit code 70.
struct BrokenPrecondition : Error {
  explicit BrokenPrecondition(const std::string& message) : Error(ExitCode::kBug, message) {}
};

/// Throws BrokenPrecondition unless `condition` holds. \param parts  concatenated to the message.
template <class... Parts>
void require(bool condition, const Parts&... parts) {
  if (!condition) [[unlikely]] {
    throw BrokenPrecondition(concat(parts...));
  }
}

}  // namespace crowdface
