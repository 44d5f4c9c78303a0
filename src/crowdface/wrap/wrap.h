// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
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

/// Distances between a landmark of the template and the same landmark of the scan, at different
/// stages of the wrap.
struct LandmarkResidual {
  std::string name;
  double pose_distance_mm = 0;  ///< distance when only the pose (a similarity) is fitted
  /// Distance between the landmark on the wrapped template and on the scan.
  double final_distance_mm = 0;
  bool is_found_by_program = false;  ///< see `WrapLandmark::is_found_by_program`
  /// whether the final distance is far above the other landmarks' distances; then the landmark is
  /// probably misplaced
  bool is_outlier = false;
  double error_mm = 0;  ///< see `WrapLandmark::error_mm`
};

/// A feature of the template, and whether the wrap has placed this feature on the same feature of
/// the scan.
struct FeatureCheck {
  std::string name;
  ReliefCorrelation correlation;             ///< agreement of the reliefs before and after the wrap
  std::vector<std::uint32_t> skin_vertices;  ///< vertex indices in the skin, ascending
  /// Of the mouth: see `find_scan_lip_line`. Nothing for the other features, or if the scan has no
  /// clear line between the lips.
  std::optional<ScanLipLine> scan_lip_line = {};

  /// Agreement of the feature with the scan: 1 is best, below 0.7 the feature may be misplaced. The
  /// agreement of a mouth depends on the line between the lips, because two people's mouths may
  /// differ more in relief than one person's mouth and chin.
  double agreement() const {
    constexpr double kZeroAgreementMm = 7;  // so a mouth is doubtful if it is 3.2 mm off
    return scan_lip_line ? 1 - std::abs(scan_lip_line->offset_mm) / kZeroAgreementMm
                         : correlation.correlation_at_feature;
  }
  /// Whether the agreement is so high that the feature cannot be doubtful.
  bool is_high() const { return agreement() >= ReliefCorrelation::kHigh; }
  /// Whether the template's feature probably lies on another part of the scan.
  bool is_doubtful() const {
    return scan_lip_line ? agreement() < ReliefCorrelation::kDoubtful : correlation.is_doubtful();
  }
};

/// A template that was wrapped onto a scan, and measures of the quality.
struct WrapResult {
  /// Vertices of the whole template after the wrap: #V by 3, in the template's frame, in
  /// millimetres.
  Positions positions;
  Similarity pose;  ///< similarity transform from the template's frame (mm) to the scan's frame
  std::vector<LandmarkResidual> landmarks;  ///< the residuals of all landmarks used
  /// One check per feature; set by `wrap_checked`, empty after `wrap`.
  std::vector<FeatureCheck> features;
  /// Names of automatically found landmarks that `wrap_checked` did not use. Without these
  /// landmarks, the features of the face agree better before and after the wrap (see FeatureCheck).
  std::vector<std::string> dropped_landmarks;
  /// median distance between the scan and the template after the pose fit (translation, rotation
  /// and scale), before the template is bent
  double pose_residual_mm = 0;
  Eigen::VectorXd distance_mm;  ///< one per skin vertex: its distance from the scan after the wrap
  /// for each skin vertex: true if the scan has no data near the vertex, or if only the scan's
  /// boundary is near
  std::vector<bool> lacks_data;
  Index folded_triangle_count = 0;  ///< number of triangles of the skin that remain folded
  /// Distance in mm between two estimates of the point between the eyes: on the wrapped template,
  /// and on the face found by the scan's relief. Nothing if a face was not found, or if enough
  /// landmarks were picked.
  std::optional<double> eye_midpoint_difference_mm;
};

/// Restricts a model of whole heads to the vertices of the template's skin. If the template is
/// nearly symmetric, the function also adds the mirror images of the heads to the model.
ShapeModel skin_model(const ShapeModel& heads, const WrapTemplate& wrap_template);

/// smallest number of landmarks from which `wrap` can determine the pose
inline constexpr std::size_t kMinLandmarks = 4;

/// Deforms the template's skin onto the scan; eyes, teeth and lashes follow the skin.
/// \param model  shape model of the template's skin, in the template's frame and in millimetres; or
///               nullptr.
/// \param landmarks  vertices of the whole template, positions in the scan's frame; the function
/// ignores landmarks outside the skin.
/// \param closed_lips  The line between the template's lips, if they must not come apart. Empty: the
///                     wrap may open the mouth.
/// \throws InvalidInput if there are fewer than kMinLandmarks landmarks and no hint, or if the scan
/// has no data near the landmarks.
WrapResult wrap(const WrapTemplate& wrap_template, const ShapeModel* model, const Scan& scan,
                const std::vector<WrapLandmark>& landmarks, const std::optional<PoseHint>& hint,
                const LipLine& closed_lips = {});

/// Wraps the template, and checks whether each feature of the template ended on the same feature of
/// the scan (see `FeatureCheck::agreement`). If a feature's agreement is not high, repeats the wrap
/// without the automatically found landmarks of this feature, and then without all automatically
/// found landmarks. Takes the result whose worst feature agrees best. If the scan's mouth is closed
/// but this result's mouth is open, repeats the wrap with `closed_lips`.
/// \param features  see `face_features`; may be empty
/// \param wrap_template, model, scan, landmarks, hint  as for `wrap`
WrapResult wrap_checked(const WrapTemplate& wrap_template, const ShapeModel* model,
                        const std::vector<FaceFeature>& features, const Scan& scan,
                        const std::vector<WrapLandmark>& landmarks,
                        const std::optional<PoseHint>& hint);

/// Cross-validates the wrap: returns, by landmark name, the distance in mm between the landmark's
/// picked position and its position in a wrap that does not use this landmark. The distance
/// estimates the error of the wrap in places without landmarks, plus the picking error. The
/// function runs one wrap per landmark if there are at most eleven landmarks, otherwise four wraps.
/// The result is empty if too few landmarks would remain.
/// \param wrap_template, model, scan, landmarks, hint  as for `wrap`
std::map<std::string, double> cross_validate_wrap(const WrapTemplate& wrap_template,
                                                  const ShapeModel* model, const Scan& scan,
                                                  const std::vector<WrapLandmark>& landmarks,
                                                  const std::optional<PoseHint>& hint);

}  // namespace crowdface
