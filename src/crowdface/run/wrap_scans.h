// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/run/wrap_inputs.h"

namespace crowdface {

/// Fits the template to a scan or to a folder of scans, and writes heads, reports and images. With
/// `batch`, skips scans that are already wrapped, continues after a failed scan, and reports all
/// problems at the end.
/// \throws Error that names the faulty file or option.
void wrap_scans(const WrapOptions& options);

}  // namespace crowdface
