// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/cast/likeness.h"
#include "crowdface/crowd/plan_file.h"
#include "crowdface/plane/layout.h"

namespace crowdface {

/// The data about a crowd that sheets and gallery need to sort faces: which faces are similar, and
/// the anchors of the heads. (Each head has an anchor, a point on the weight plane; the distances
/// of a face's position from the anchors determine the weights with which the heads are blended.)
struct CrowdLikeness {
  /// one per head: the head's anchor, a point on the weight plane
  std::vector<PlanePoint> anchors;
  /// for each face, the faces nearest to it; and an order of all faces in which consecutive faces
  /// look alike
  Likeness likeness;
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
