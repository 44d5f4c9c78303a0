// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include <pybind11/pybind11.h>

namespace crowdface::python {

/// Runs `work` on a thread of its own, without Python's lock. Meanwhile the calling thread handles
/// Python's signals, so that Ctrl-C works, and calls `progress(stage, done, total)` about ten times
/// a second. If a signal handler or `progress` raises an exception, or `progress` returns False,
/// cancels the work and waits for its end. Calls of several threads run one after the other.
/// \param progress  a callable or None.
/// \throws the exception of the handler, of `progress` or of `work`; Interrupted.
void long_call(const pybind11::object& progress, const std::function<void()>& work);

}  // namespace crowdface::python
