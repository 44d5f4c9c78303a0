// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Copies material files and textures into the folder of meshes. Copies the files of all target
/// heads if OBJ files refer to these files. Copies the files of attachments if separate attachment
/// files or USD layers refer to these files.
/// \return warnings about problems that `inputs.warnings` does not mention, one warning per
///         problem. Each warning names the affected heads. Warnings are also logged.
std::vector<std::string> copy_materials(const Config& config, const Inputs& inputs,
                                        const CrowdDirectory& directory,
                                        const std::vector<FacePlan>& crowd, Ledger& ledger);

}  // namespace crowdface
