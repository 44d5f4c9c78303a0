// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/run/job.h"

namespace crowdface {

/// Rejects an output folder that cannot be written. Also rejects an output folder in which the run
/// would overwrite the job's inputs, or a crowd that cannot be made again.
/// \throws UsageError, CannotCreate.
void check_output(const Job& job, Replace replace);

/// Prepares the folder for the job's crowd. The caller must hold the folder's lock. Repeats those
/// checks of check_output whose result may have changed because of another run.
/// \throws UsageError, CannotCreate, IoError.
void prepare_output_folder(const Job& job, Replace replace);

/// Refuses to replace a crowd that was cast from other heads or masks than this job's, because the
/// run could not make the old crowd again.
/// \throws UsageError if the folder holds a crowd with other heads or masks, and `replace` is not
///         kForce.
/// \param settings  this job's settings_digest
void refuse_other_heads(const Digest& settings, const CrowdDirectory& directory, Replace replace);

/// Compares the inputs with the report in the folder.
/// \throws UsageError if the textures, attachments, shapes, points or rig of the faces in the
///         folder differ from the inputs.
void refuse_other_inputs(const Inputs& inputs, const CrowdDirectory& directory);

}  // namespace crowdface
