// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/run/pipeline.h"

namespace crowdface {

/// Refuses a folder that the crowd cannot be written to, or where it would destroy what it reads or
/// what could not be made again. \throws UsageError, CannotCreate.
void check_output(const Job& job, Replace replace);

/// Makes the folder ready for the job's crowd, once nobody else writes there. Looks again at what another run may have
/// changed since check_output. \throws UsageError, CannotCreate, IoError.
void open_output(const Job& job, Replace replace);

/// \throws UsageError if the folder's crowd was cast from other heads: it could not be made again.
/// \param settings  of the heads as they are now, see settings_digest.
void refuse_other_heads(const Digest& settings, const CrowdDirectory& directory, Replace replace);

/// \throws UsageError if the report says that the folder's faces have other textures, attachments, shapes,
/// points or another rig than these.
void refuse_other_inputs(const Inputs& inputs, const CrowdDirectory& directory);

}  // namespace crowdface
