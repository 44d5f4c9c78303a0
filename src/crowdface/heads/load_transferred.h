// SPDX-License-Identifier: Apache-2.0
// Loads what every face gets in addition to its head: shapes, points, a rig, attachments, and the
// fit to a body. Each function requires inputs whose heads and parts are known, and adds all faults
// of the files to its argument `problems`.
#pragma once

#include "crowdface/config/config.h"
#include "crowdface/core/problems.h"
#include "crowdface/heads/cache_folder.h"
#include "crowdface/heads/inputs.h"

namespace crowdface {

/// Places all heads on the body that the config section `neck` names. Requires only that the heads
/// are aligned. A neck that cannot be found or does not fit the body is a problem.
void load_neck(const Config& config, Inputs& inputs, Problems& problems);

/// Loads the shapes in parallel. Shapes that a head lacks are transferred from the template. A mesh
/// that cannot be read or has another topology than the heads is a problem.
/// \param cache  folder that keeps what was read; empty: no cache
void load_shapes(const Config& config, const CacheFolder& cache, Inputs& inputs,
                 Problems& problems);

/// Loads the named points; the shapes must be loaded before. Reports these problems with their line
/// in the file: a value that is not a position, a missing head, a template with another topology.
void load_points(const Config& config, Inputs& inputs, Problems& problems);

/// Loads the rig; the shapes must be loaded before. Matches the rig's vertices to the heads'
/// vertices by the attribute `_VERTEX_ID`. Without this attribute, matches them by
/// position: the rig's mesh must have the vertices of the shapes' template or of one of the heads,
/// at rest. Reports as problems: a head vertex that has no match; a joint that is mirrored, sheared
/// or scaled non-uniformly; and a mesh that is far from the heads or of another size.
void load_rig(const Config& config, Inputs& inputs, Problems& problems);

/// Loads the attachments in parallel. These faults are problems: an attachment's mesh cannot be
/// read; the mesh lies far from the head; the head to which the attachment was fitted has another
/// topology than the heads of `inputs`. Faults in materials only cause warnings.
/// \param cache  see load_shapes
void load_attachments(const Config& config, const CacheFolder& cache, Inputs& inputs,
                      Problems& problems);

}  // namespace crowdface
