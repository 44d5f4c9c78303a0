// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Reads the vertex positions of a face from its mesh file in the first of `formats` that crowdface
/// can read.
/// \throws MissingInput if there is no such format or the file does not exist; InvalidInput if the
///         file does not belong to this crowd.
Positions read_face_positions(const CrowdDirectory& directory, const std::string& id,
                              const std::vector<MeshFormat>& formats, Index vertices);

}  // namespace crowdface
