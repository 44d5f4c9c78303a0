// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// After this call, the first SIGINT, SIGTERM, SIGHUP or SIGXCPU only sets the flag that
/// `is_interrupted` returns. If the program still runs 0.7 s later, it ends at once with
/// ExitCode::kInterrupted. A second signal ends the program at once. Signals that the process
/// ignores (SIGHUP under nohup) stay ignored. The timer for the 0.7 s uses the signal SIGRTMIN.
/// Only programs may call this function, not libraries.
void catch_interrupts();

/// Whether a signal that catch_interrupts watches has arrived, or work is cancelled (cancel.h).
bool is_interrupted();

/// Ends the work if it is interrupted. Long loops call this function between units of work.
/// \throws Interrupted if `is_interrupted` is true.
void throw_if_interrupted();

}  // namespace crowdface
