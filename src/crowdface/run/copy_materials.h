// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/ledger.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Copies material files and textures of all heads that are targets beside the meshes.
/// \return warnings that the inputs do not have, each once with the heads it is about; also logged.
std::vector<std::string> copy_materials(const Inputs& inputs, const CrowdDirectory& directory,
                                        const std::vector<CastFace>& crowd, Ledger& ledger);

}  // namespace crowdface
