// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/cast/likeness.h"
#include "crowdface/crowd/plan_file.h"
#include "crowdface/plane/layout.h"

namespace crowdface {

/// The similarities of faces, and the heads' positions on the weight plane, for sheets and gallery.
struct CrowdLikeness {
  std::vector<PlanePoint> anchors;  ///< one per head: its position on the weight plane
  Likeness likeness;                ///< the nearest faces of each face, and an order of the faces
};

/// Computes the CrowdLikeness of a crowd that was just cast. Rounds distances to four decimals, as
/// likeness.json does, so that sheets made from likeness.json equal the sheets of this run.
/// \param points  one point per face.
CrowdLikeness crowd_likeness(const std::vector<PlanePoint>& anchors,
                             const std::vector<FaceSpace::Point>& points);

/// The text of likeness.json (docs/crowd-directory.md). All arguments must outlive the text.
/// \param ids  ids of the faces.
TextPieces likeness_text(const CrowdLikeness& likeness, const PlanNames& names,
                         const std::vector<std::string>& ids);

/// Reads likeness.json.
/// \param ids  ids of the faces, in the order of the plan.
/// \throws MissingInput if the file does not exist; InvalidInput if the file belongs to another
/// crowd.
CrowdLikeness read_likeness(const std::filesystem::path& path, const PlanNames& names,
                            const std::vector<std::string>& ids);

}  // namespace crowdface
