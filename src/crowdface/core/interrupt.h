// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// After this call, the first SIGINT, SIGTERM, SIGHUP or SIGXCPU only sets the flag that
/// `interrupted` returns; a second one ends the program. Signals that are ignored (SIGHUP under
/// nohup) stay ignored.
void catch_interrupts();

/// Whether one of these signals has arrived.
bool interrupted();

/// \throws Interrupted if one of these signals has arrived. Long loops call it between units of
/// work.
void throw_if_interrupted();

}  // namespace crowdface
