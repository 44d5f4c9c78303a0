// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// Stops all work of the library in this process: `is_interrupted` returns true until
/// `end_cancellation` is called, and long loops throw Interrupted. Meant for programs in which a
/// user can cancel a call that runs on another thread. Thread-safe.
void cancel_work();
/// Ends the effect of `cancel_work`: work may start again.
void end_cancellation();
/// Whether `cancel_work` was called and `end_cancellation` was not called afterwards.
bool is_cancelled();

}  // namespace crowdface
