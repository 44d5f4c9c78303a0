// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// After this call, the first SIGINT, SIGTERM, SIGHUP or SIGXCPU only sets the flag that
/// `interrupted` returns. If the program still runs 0.7 s later, or at a second signal, it ends at
/// once, with ExitCode::kInterrupted or by the signal. Signals that are ignored (SIGHUP under nohup)
/// stay ignored. For programs only; uses SIGRTMIN.
void catch_interrupts();

/// Whether one of these signals has arrived.
bool interrupted();

/// \throws Interrupted if one of these signals has arrived. Long loops call it between units of
/// work.
void throw_if_interrupted();

}  // namespace crowdface
