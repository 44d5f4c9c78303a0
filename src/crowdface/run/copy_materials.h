// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Copies material files and textures beside the meshes: of all heads that are targets, if OBJ files name
/// them, and of attachments, if files beside or USD layers do.
/// \return warnings that the inputs do not have, each once with the heads it is about; also logged.
std::vector<std::string> copy_materials(const Config& config, const Inputs& inputs,
                                        const CrowdDirectory& directory,
                                        const std::vector<CastFace>& crowd, Ledger& ledger);

}  // namespace crowdface
