// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/cancel.h"

#include <atomic>

namespace crowdface {
namespace {

std::atomic<bool> cancelled = false;

}  // namespace

void cancel_work() {
  cancelled = true;
}

void end_cancellation() {
  cancelled = false;
}

bool is_cancelled() {
  return cancelled;
}

}  // namespace crowdface
