// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "crowdface/wrap/feature_check.h"
#include "crowdface/wrap/guess_pose.h"
#include "crowdface/wrap/shape_fit.h"
#include "crowdface/wrap/shape_model.h"
#include "crowdface/wrap/wrap_template.h"

namespace crowdface {

/// Distance between a landmark of the template and the same landmark of the scan.
struct LandmarkResidual {
  std::string name;
  double pose_mm = 0;     ///< distance after the similarity
  double final_mm = 0;    ///< distance after the wrap
  bool by_shape = false;  ///< see `WrapLandmark::by_shape`
  /// whether the final distance is far above the others; the landmark is probably misplaced
  bool outlier = false;
  double error_mm = 0;  ///< see `WrapLandmark::error_mm`
};

/// A feature with a smaller agreement is doubtful.
inline constexpr double kDoubtfulAgreement = 0.7;

/// Agreement of a feature's relief on the wrapped template with the relief on the template; see
/// `relief_agreements`.
struct FeatureAgreement {
  std::string name;
  double agreement = 1;
  std::vector<std::uint32_t> skin;  ///< rows of the skin, ascending
  bool is_doubtful() const { return agreement < kDoubtfulAgreement; }
};

struct WrapResult {
  Positions positions;  ///< #V by 3 of the whole template, in its frame, in millimetres
  Similarity pose;      ///< similarity transform from the template's frame (mm) to the scan's frame
  std::vector<LandmarkResidual> landmarks;
  std::vector<FeatureAgreement> features;  ///< set by `wrap_checked` only
  /// Names of the landmarks that `wrap_checked` found but did not use, because they made a feature
  /// doubtful.
  std::vector<std::string> dropped_landmarks;
  double pose_residual_mm = 0;  ///< median distance after the similarity
  Eigen::VectorXd distance_mm;  ///< #skin: distance from the wrapped skin to the scan
  /// #skin: whether the vertex has no scan data nearby, or only the scan's boundary
  std::vector<bool> lacks_data;
  Index flipped = 0;  ///< number of flipped triangles in the skin
  /// Distance in mm between the point between the eyes on the wrapped template and the same point
  /// of the face that was found from the scan's relief. Nothing if one of the two faces was not
  /// found, or if enough landmarks were picked.
  std::optional<double> face_off_mm;
};

/// Restricts a model of whole heads to the rows of the template's skin. If the template is nearly
/// symmetric, adds the mirror images of the heads.
ShapeModel skin_model(const ShapeModel& heads, const WrapTemplate& shape);

inline constexpr std::size_t kMinLandmarks = 4;  ///< landmarks needed to determine the pose

/// Deforms the template's skin onto the scan; eyes, teeth and lashes follow the skin.
/// \param model  of the template's skin, in its frame and in millimetres; or nullptr.
/// \param landmarks  vertices of the whole template, positions in the scan's frame; the function
/// ignores landmarks outside the skin.
/// \throws InvalidInput if there are fewer than kMinLandmarks and no hint, or if the scan has no
/// data near the landmarks.
WrapResult wrap(const WrapTemplate& shape, const ShapeModel* model, const Scan& scan,
                const std::vector<WrapLandmark>& landmarks, const std::optional<PoseHint>& hint);

/// Wraps, and checks with `relief_agreements` whether each feature of the template ended on the same
/// feature of the scan. If a feature is doubtful, repeats the wrap without the landmarks by shape
/// that lie on this feature, and then without all landmarks by shape. Returns the result whose worst
/// feature agrees best.
/// \param features  see `face_features`; may be empty
/// \param shape, model, scan, landmarks, hint  as for `wrap`
WrapResult wrap_checked(const WrapTemplate& shape, const ShapeModel* model,
                        const std::vector<FaceFeature>& features, const Scan& scan,
                        const std::vector<WrapLandmark>& landmarks,
                        const std::optional<PoseHint>& hint);

/// Leave-out validation: the distance in mm between each landmark's picked position and its
/// position in a wrap that does not use this landmark. The distance estimates the error of
/// correspondence where no landmark was picked, plus the picking error. Needs one more wrap per
/// landmark for up to eleven landmarks, and four more wraps for twelve and more; empty if too few
/// landmarks would remain.
/// \param shape, model, scan, landmarks, hint  as for `wrap`
std::map<std::string, double> unseen_landmarks(const WrapTemplate& shape, const ShapeModel* model,
                                               const Scan& scan,
                                               const std::vector<WrapLandmark>& landmarks,
                                               const std::optional<PoseHint>& hint);

}  // namespace crowdface
