// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {

/// A function was called against its stated precondition: our own mistake, never a user's data (70).
struct BrokenPrecondition : Error {
  explicit BrokenPrecondition(const std::string& message) : Error(ExitCode::kBug, message) {}
};

/// Throws BrokenPrecondition with a message of these parts unless the condition holds.
template <class... Parts>
void require(bool condition, const Parts&... parts) {
  if (!condition) [[unlikely]] {
    throw BrokenPrecondition(concat(parts...));
  }
}

}  // namespace crowdface
