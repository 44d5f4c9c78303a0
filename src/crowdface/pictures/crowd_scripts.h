// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/cast/cast_face.h"
#include "crowdface/config/config.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/likeness_file.h"
#include "crowdface/shapes/shape_set.h"

namespace crowdface {

/// What the gallery knows of a crowd's recipes, as scripts: data/crowd.js, and of a crowd in numbered
/// subfolders there only what filters and orders need of each face; the recipes lie in data/pages,
/// as many faces a script as a subfolder, which the page loads as it shows them.
void write_crowd_scripts(const CrowdDirectory& directory, const Config& config,
                         const ShapeSet& shapes, const std::vector<CastFace>& crowd,
                         const Digest& settings, const CrowdLikeness& likeness);

}  // namespace crowdface
