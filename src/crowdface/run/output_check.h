// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Rejects an output folder that cannot be written. Also rejects it if the crowd would overwrite
/// its own inputs, or files that could not be made again. \throws UsageError, CannotCreate.
void check_output(const Job& job, Replace replace);

/// Prepares the folder for the job's crowd. The caller must hold the folder's lock. Repeats the
/// checks of check_output whose result another run may have changed since.
/// \throws UsageError, CannotCreate, IoError.
void open_output(const Job& job, Replace replace);

/// \throws UsageError if the folder's crowd was cast from other heads, because it could not be made
///     again.
/// \param settings  hash of the present heads, see settings_digest
void refuse_other_heads(const Digest& settings, const CrowdDirectory& directory, Replace replace);

/// \throws UsageError if, according to its report, the folder's faces have other textures,
///         attachments, shapes, points or another rig than these inputs.
void refuse_other_inputs(const Inputs& inputs, const CrowdDirectory& directory);

}  // namespace crowdface
