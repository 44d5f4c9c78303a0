// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/wrap_inputs.h"

namespace crowdface::cli {

/// `wrap --pick`: serves the page on which landmarks of template and scan are picked. \throws Error
void pick(const WrapOptions& options);

}  // namespace crowdface::cli
