// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/shape_model.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// How far a landmark of the template is from that of the scan.
struct LandmarkResidual {
  std::string name;
  double pose_mm = 0;     ///< after the similarity
  double final_mm = 0;    ///< after the wrap
  bool by_shape = false;  ///< as of the landmark
  bool outlier = false;   ///< in the end far beyond the others: most likely misplaced
};

struct WrapResult {
  Positions positions;  ///< #V by 3 of the whole template, in its frame, in millimetres
  Similarity pose;      ///< from the template's frame (mm) to the scan's
  std::vector<LandmarkResidual> landmarks;
  double pose_residual_mm = 0;     ///< median distance after the similarity
  Eigen::VectorXd distance_mm;     ///< #skin: from the wrapped skin to the scan
  std::vector<bool> without_data;  ///< #skin: nothing of the scan is near, or only its rim
  Index flipped = 0;               ///< triangles of the skin
  /// How far the template's place between the eyes ends from that of the face which the scan's relief shows, mm; nothing
  /// if no such face is found on one of them, or enough landmarks were picked.
  std::optional<double> face_off_mm;
};

/// The model of whole heads at the rows of the template that are skin; where the template is nearly its own
/// mirror image, with the heads' mirror images.
ShapeModel skin_model(const ShapeModel& heads, const WrapTemplate& shape);

inline constexpr std::size_t kFewestLandmarks = 4;  ///< that tell how a scan stands

/// Bends the template's skin onto the scan; eyes, teeth and lashes follow.
/// \param model      of the template's skin, in its frame and in millimetres; or nullptr.
/// \param landmarks  rows of the whole template, places in the scan's frame; those beyond the skin are
///                   left out.
/// \throws InvalidInput if there are fewer than kFewestLandmarks and no hint, or nothing of the scan is
/// where the landmarks say.
WrapResult wrap(const WrapTemplate& shape, const ShapeModel* model, const Scan& scan,
                const std::vector<WrapLandmark>& landmarks, const std::optional<PoseHint>& hint);

/// How far each landmark ends from where it was picked when the wrap does not know it, in mm: an estimate of how well
/// places correspond where none was picked, the error of picking along. One more wrap for each of up to eleven
/// landmarks, four more for others; nothing where too few would be left.
/// \param shape, model, scan, landmarks, hint  as wrap takes them
std::map<std::string, double> unseen_landmarks(const WrapTemplate& shape, const ShapeModel* model,
                                               const Scan& scan,
                                               const std::vector<WrapLandmark>& landmarks,
                                               const std::optional<PoseHint>& hint);

}  // namespace crowdface
