// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/face_plan.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Copies material files and textures to the meshes' folder: the files of all target heads if OBJ
/// files refer to them, and the files of attachments if separate files or USD layers refer to them.
/// \return new warnings (not in the inputs' list), without duplicates, each with the heads
///         concerned; also logged.
std::vector<std::string> copy_materials(const Config& config, const Inputs& inputs,
                                        const CrowdDirectory& directory,
                                        const std::vector<FacePlan>& crowd, Ledger& ledger);

}  // namespace crowdface
