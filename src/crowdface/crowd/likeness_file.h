// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/cast/likeness.h"
#include "crowdface/crowd/plan_file.h"
#include "crowdface/plane/layout.h"

namespace crowdface {

/// What sheets and gallery show of a crowd beside its plan and its meshes.
struct CrowdLikeness {
  std::vector<PlanePoint> anchors;  ///< #heads, where they stand on the plane
  Likeness likeness;
};

/// Of a crowd that was just cast. Distances have four decimals, as in the file, so that pictures made
/// from that are the same. \param points  #faces.
CrowdLikeness crowd_likeness(const std::vector<PlanePoint>& anchors,
                             const std::vector<FaceSpace::Point>& points);

/// likeness.json (docs/crowd-directory.md). All must outlive the text. \param ids  of the faces.
TextPieces likeness_text(const CrowdLikeness& likeness, const PlanNames& names,
                         const std::vector<std::string>& ids);

/// Reads it back. \param ids  of the plan, in its order.
/// \throws MissingInput if it is not there, InvalidInput if it is of another crowd.
CrowdLikeness read_likeness(const std::filesystem::path& path, const PlanNames& names,
                            const std::vector<std::string>& ids);

}  // namespace crowdface
