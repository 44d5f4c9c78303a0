// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "crowdface/editor/edit_session.h"

namespace crowdface {

/// How long the server takes for what a page asks when the mouse is let go: the full face after a
/// controller, the smoothness or the target has changed, as a table beside the paper's frame.
/// \param opened_seconds  what opening the job took
std::string edit_benchmark(const EditSession& session, double opened_seconds);

}  // namespace crowdface
