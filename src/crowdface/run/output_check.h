// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Rejects an output folder that cannot be written. Also rejects an output folder in which the
/// crowd would overwrite the job's inputs, or files that could not be made again. \throws
/// UsageError, CannotCreate.
void check_output(const Job& job, Replace replace);

/// Prepares the folder for the job's crowd. The caller must hold the folder's lock. Repeats those
/// checks of check_output whose result may have changed because of another run.
/// \throws UsageError, CannotCreate, IoError.
void open_output(const Job& job, Replace replace);

/// Refuses to replace a crowd that was cast from other heads, because that crowd could not be made
/// again.
/// \throws UsageError in this case.
/// \param settings  hash of the present heads, see settings_digest
void refuse_other_heads(const Digest& settings, const CrowdDirectory& directory, Replace replace);

/// Compares the inputs with the report in the folder.
/// \throws UsageError if the faces in the folder have other textures, attachments, shapes, points
/// or another rig than these inputs.
void refuse_other_inputs(const Inputs& inputs, const CrowdDirectory& directory);

}  // namespace crowdface
