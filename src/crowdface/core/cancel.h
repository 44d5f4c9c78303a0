// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// Stops all work of the library in this process: `interrupted` returns true until `end_cancellation` is
/// called, and long loops throw Interrupted. For programs in which a user may cancel a call that
/// runs on another thread. Thread-safe.
void cancel_work();
/// Ends the effect of `cancel_work`: work may start again.
void end_cancellation();
/// Whether `cancel_work` was called and `end_cancellation` was not called afterwards.
bool is_cancelled();

}  // namespace crowdface
