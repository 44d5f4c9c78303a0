// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

#include "crowdface/core/text.h"

namespace crowdface {

/// A function was called against its stated precondition: our own mistake, never a user's data (70).
struct BrokenPrecondition : std::logic_error {
  using std::logic_error::logic_error;
};

/// Throws BrokenPrecondition with a message of these parts unless the condition holds.
template <class... Parts>
void require(bool condition, const Parts&... parts) {
  if (!condition) [[unlikely]] {
    throw BrokenPrecondition(concat(parts...));
  }
}

}  // namespace crowdface
