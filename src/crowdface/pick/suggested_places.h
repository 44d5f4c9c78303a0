// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/mirror_map.h"
#include "crowdface/pick/landmark_file.h"
#include "crowdface/pick/pickable_mesh.h"

namespace crowdface {

/// How the template stands on the scan, as far as pairs of places tell.
struct LandmarkPose {
  Similarity pose;  ///< from the template (mm) to the scan's unit
  struct Residual {
    double mm =
        0;  ///< from where the other pairs put it (of three pairs: from where they do together)
    bool outlier =
        false;  ///< far beyond the others: most likely misplaced, and left out of the pose
  };
  std::map<std::string, Residual> residuals;  ///< of all pairs
};

/// Fits the similarity (Umeyama 1991) to at least three pairs that are not in a line; while one is far
/// beyond the others it is left out.
/// \return nothing if there are fewer.
std::optional<LandmarkPose> pose_of_picked(const std::vector<PickedLandmark>& landmarks,
                                           const Positions& of_template);

/// Where names that have been picked on the other half, or on the template, are likely to be.
struct SuggestedPlaces {
  std::map<std::string, PickedPlace> of_template;
  std::map<std::string, PickedPlace> of_scan;
  std::optional<LandmarkPose> pose;
};

/// \param of_template  in millimetres
/// \param plane        between its halves
/// \param proposals    rows of the template that its shape tells, used where nothing is picked
SuggestedPlaces suggest_places(const std::vector<PickedLandmark>& landmarks,
                               const PickableMesh& of_template, const PickableMesh& of_scan,
                               const MirrorPlane& plane,
                               const std::map<std::string, std::uint32_t>& proposals);

}  // namespace crowdface
