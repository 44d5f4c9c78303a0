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

/// Similarity transform from template to scan, fitted to landmark pairs.
struct LandmarkPose {
  Similarity pose;  ///< maps the template (mm) to the scan, in the unit of the scan
  /// How well a landmark pair (a landmark on the template and the same landmark on the scan) agrees
  /// with the other pairs.
  struct Residual {
    /// Distance in mm between the pair's template landmark, transformed by a fit, and the pair's
    /// scan landmark. This fit leaves out the pair itself and all outliers. If the remaining pairs
    /// are too few or almost on a line, the fit is `pose`.
    double distance_mm = 0;
    /// Whether the distance is far larger than the distances of the other pairs, probably because a
    /// landmark was misplaced. The fit of `pose` ignores outliers.
    bool is_outlier = false;
  };
  /// by landmark name: the residual of the pair of this landmark
  std::map<std::string, Residual> residuals;
};

/// Estimates, from pairs of landmarks, the similarity transform that maps the template to the scan
/// (Umeyama 1991). Removes outlier pairs one by one, and repeats the fit after each removal.
/// \return nothing if there are fewer than three pairs, or if the landmarks lie almost on a line.
std::optional<LandmarkPose> fit_pose_to_picked(const std::vector<PickedLandmark>& landmarks,
                                               const Positions& template_positions);

/// Likely positions of landmarks that are not picked yet, keyed by landmark name. A position on the
/// template is the mirror image of a picked landmark, or a proposal from the template's shape. A
/// position on the scan is the picked or suggested position on the template, mapped by `pose`,
/// corrected by the residuals of nearby pairs, and projected to the scan's skin.
struct SuggestedPlaces {
  /// by landmark name: the suggested position of the landmark on the template
  std::map<std::string, PickedPlace> template_places;
  /// by landmark name: the suggested position of the landmark on the scan
  std::map<std::string, PickedPlace> scan_places;
  std::optional<LandmarkPose> pose;  ///< pose of the template on the scan; see fit_pose_to_picked
};

/// Suggests likely positions of the landmarks that are not picked yet.
/// \param template_mesh  the template, in millimetres
/// \param plane        symmetry plane of the template
/// \param proposals    template vertices estimated from shape, for names that are not picked
SuggestedPlaces suggest_places(const std::vector<PickedLandmark>& landmarks,
                               const PickableMesh& template_mesh, const PickableMesh& scan_mesh,
                               const MirrorPlane& plane,
                               const std::map<std::string, std::uint32_t>& proposals);

}  // namespace crowdface
