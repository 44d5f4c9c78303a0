// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// After this call, the first SIGINT, SIGTERM, SIGHUP or SIGXCPU only sets the flag that
/// `interrupted` returns. If the program still runs 0.7 s later, or at a second signal, it ends at
/// once, with ExitCode::kInterrupted or by the signal. Signals that are ignored (SIGHUP under nohup)
/// stay ignored. For programs only; uses SIGRTMIN.
void catch_interrupts();

/// Whether a signal of catch_interrupts has arrived or work is cancelled (cancel.h).
bool interrupted();

/// Long loops call this function between units of work. \throws Interrupted if `interrupted` is
/// true.
void throw_if_interrupted();

}  // namespace crowdface
