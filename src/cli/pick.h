// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/wrap_inputs.h"

namespace crowdface::cli {

/// Executes `wrap --pick`: serves the page on which the user picks landmarks of template and scan.
/// \throws Error
void pick(const WrapOptions& options);

}  // namespace crowdface::cli
