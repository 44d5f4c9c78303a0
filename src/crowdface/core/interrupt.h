// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace crowdface {

/// From now on SIGINT, SIGTERM, SIGHUP and SIGXCPU are remembered instead of ending the program; a
/// second one ends it at once. One that is ignored (SIGHUP under nohup) stays so.
void catch_interrupts();

/// Whether such a signal has come.
bool interrupted();

/// \throws Interrupted if such a signal has come. Long loops call it between pieces of work.
void throw_if_interrupted();

}  // namespace crowdface
