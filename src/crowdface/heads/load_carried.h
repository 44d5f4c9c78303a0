// SPDX-License-Identifier: Apache-2.0
// What a config has carried to every face. Each is read into inputs whose faces and parts are known, and
// adds every problem that it has.
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// The shapes, read in parallel. What a head lacks is carried to it from the template. A problem is a mesh
/// that cannot be read, or is not in the heads' topology.
/// \param cache  the folder that keeps what was read; empty: none
void load_shapes(const Config& config, const CacheFolder& cache, Inputs& inputs,
                 Problems& problems);

/// The points, after the shapes. Problems are told with their line: a value that is no position, a head
/// that is missing, a template that is not in the heads' topology.
void load_points(const Config& config, Inputs& inputs, Problems& problems);

/// The rig, after the shapes. Its vertices are found by `_VERTEX_ID`, or by where they lie on the shapes'
/// template or on one of the heads. A problem is a vertex of the heads that has none, or a joint whose
/// scale is not the same along its axes.
void load_rig(const Config& config, Inputs& inputs, Problems& problems);

/// The attachments, read in parallel. A problem is a mesh that cannot be read, one that lies far from the
/// head, a fitted head in another topology. What their materials lack is warned of.
/// \param cache  as of load_shapes
void load_attachments(const Config& config, const CacheFolder& cache, Inputs& inputs,
                      Problems& problems);

}  // namespace crowdface
