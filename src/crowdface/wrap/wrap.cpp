// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/wrap.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/component_shape.h"
#include "crowdface/parts/find_mirror.h"
#include "crowdface/parts/follower.h"
#include "crowdface/wrap/bend_skin.h"
#include "crowdface/wrap/centred_scan.h"
#include "crowdface/wrap/feature_check.h"
#include "crowdface/wrap/follow_detail.h"
#include "crowdface/wrap/mirrored_landmarks.h"
#include "crowdface/wrap/scan_face.h"
#include "crowdface/wrap/shape_regression.h"
#include "crowdface/wrap/unfold.h"

namespace crowdface {
namespace {

/// A head counts as symmetric if at least this fraction of its vertices have a mirror vertex.
constexpr double kMinMirroredFraction = 0.9;
/// A landmark is an outlier if its LandmarkResidual::final_distance_mm is larger than
/// kMinOutlierMm, and larger than kOutlierFactor times the median of the final distances of all
/// landmarks.
constexpr double kMinOutlierMm = 4, kOutlierFactor = 3.5;
/// If a wrap moves closed lips apart by more than this distance, wrap_checked ties them together.
constexpr double kMaxLipGapMm = 1;

/// Converts the landmarks' vertex indices in the template to vertex indices in the skin. Drops
/// landmarks outside the skin.
std::vector<WrapLandmark> landmarks_on_skin(const SkinMesh& skin,
                                            const std::vector<WrapLandmark>& landmarks) {
  std::vector<WrapLandmark> result;
  for (const WrapLandmark& landmark : landmarks) {
    const std::uint32_t row = index_in_list(skin.vertices, landmark.vertex);
    if (row == kNoIndex) continue;
    result.push_back(landmark);
    result.back().vertex = row;
  }
  return result;
}

/// For each landmark: the distance between its position on the scan and its vertex of the
/// template's skin, after `pose` has moved the template to the scan.
std::vector<LandmarkResidual> residuals_of(const Positions& skin, const Similarity& pose,
                                           const std::vector<WrapLandmark>& landmarks) {
  std::vector<LandmarkResidual> result;
  for (const WrapLandmark& landmark : landmarks) {
    const Eigen::Vector3d point = skin.row(landmark.vertex).transpose();
    result.push_back(
        {landmark.name,
         (apply_similarity(pose, point) - landmark.scan_position).norm() / pose.scale});
    result.back().is_found_by_program = landmark.is_found_by_program;
    result.back().error_mm = landmark.error_mm;
  }
  return result;
}

/// Sets the final distance of each landmark: between its vertex on the wrapped template and its
/// position on the scan. Marks landmarks with a large final distance as outliers. The scan's
/// surface and the other landmarks pull a landmark's vertex to the correct point of the scan. If
/// the vertex is nevertheless far from the landmark's position on the scan, this position is
/// probably wrong.
void add_final(const Positions& wrapped, const std::vector<WrapLandmark>& landmarks,
               std::vector<LandmarkResidual>& residuals) {
  std::vector<double> all;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    residuals[i].final_distance_mm =
        (row3(wrapped, landmarks[i].vertex) - landmarks[i].scan_position).norm();
    all.push_back(residuals[i].final_distance_mm);
  }
  if (all.empty()) return;
  const double most = std::max(kMinOutlierMm, kOutlierFactor * nth_smallest(all, all.size() / 2));
  for (LandmarkResidual& residual : residuals)
    residual.is_outlier = residual.final_distance_mm > most;
}

void move(std::vector<WrapLandmark>& landmarks, const Similarity& motion) {
  for (WrapLandmark& landmark : landmarks) {
    landmark.scan_position = apply_similarity(motion, landmark.scan_position);
  }
}

void measure(const Positions& wrapped, const ScanSurface& scan, WrapResult& result) {
  result.distance_mm = Eigen::VectorXd::Zero(wrapped.rows());
  std::vector<char> on_boundary(static_cast<std::size_t>(wrapped.rows()), 0);
  parallel_blocks(wrapped.rows(), 1024, [&](Index begin, Index end) {
    std::uint32_t before = kNoIndex;
    for (Index v = begin; v < end; ++v) {
      const auto place = scan.nearest(row3(wrapped, v), 1e300, before);
      before = place.triangle;
      result.distance_mm(v) = place.distance;
      on_boundary[static_cast<std::size_t>(v)] = place.is_on_boundary ? 1 : 0;
    }
  });
  result.lacks_data.assign(on_boundary.begin(), on_boundary.end());
}

/// Returns pairs of vertices of `bent` on both sides of the line between the lips, with the
/// difference that they have at rest.
/// \param rest  #skin by 3, positions of the template's skin
std::vector<TiedVertices> tied_lips(const WrapTemplate& wrap_template, const LipLine& line,
                                    const Positions& rest) {
  const auto main_corner = [](const auto& barycentric) {
    return static_cast<std::size_t>(std::ranges::max_element(barycentric) - barycentric.begin());
  };
  std::vector<TiedVertices> ties;
  for (const auto& points : line) {
    TiedVertices tie;
    std::array<std::uint32_t, 2> of_skin;
    for (std::size_t i = 0; i < points.size(); ++i) {
      of_skin[i] = index_in_list(wrap_template.skin.vertices,
                                 points[i].corners[main_corner(points[i].barycentric)]);
      tie.vertices[i] = of_skin[i];
      if (const auto& reduced = wrap_template.reduced_skin) {
        const auto& place = reduced->vertex_positions[of_skin[i]];
        tie.vertices[i] = reduced->mesh.triangles[place.triangle][main_corner(place.barycentric)];
        of_skin[i] = reduced->mesh.vertices[tie.vertices[i]];
      }
    }
    if (tie.vertices[0] == tie.vertices[1]) continue;
    tie.difference = row3(rest, of_skin[1]) - row3(rest, of_skin[0]);
    ties.push_back(tie);
  }
  return ties;
}

/// How much higher the gap between the lips of the wrapped head is than the template's, in mm.
double lip_gap_increase(const WrapTemplate& wrap_template, const LipLine& line,
                        const Positions& wrapped) {
  double sum = 0;
  for (const auto& [upper, lower] : line) {
    for (const auto& [positions, sign] : {std::pair(&wrapped, 1), {&wrap_template.positions, -1}}) {
      sum += sign * (point_on(*positions, upper.corners, upper.barycentric) -
                     point_on(*positions, lower.corners, lower.barycentric))
                        .dot(wrap_template.axes.up);
    }
  }
  return line.empty() ? 0 : sum / static_cast<double>(line.size());
}

/// The inputs of a wrap, converted to the vertices of the reduced skin.
struct ReducedInputs {
  Positions rest;
  std::optional<ShapeModel> model;
  /// The landmarks at vertices of the reduced skin. Each landmark's target is shifted by the offset
  /// from the landmark's original vertex to the reduced vertex.
  std::vector<WrapLandmark> landmarks;
};

ReducedInputs reduce(const WrapTemplate& wrap_template, const Positions& rest,
                     const ShapeModel* model, const std::vector<WrapLandmark>& landmarks,
                     const Similarity& pose) {
  const SkinMesh& mesh = wrap_template.reduced_skin->mesh;
  ReducedInputs small{mesh.rows_of(rest), std::nullopt, landmarks};
  if (model != nullptr) {
    small.model = ShapeModel{mesh.rows_of(model->mean), {}};
    for (const Positions& mode : model->modes) small.model->modes.push_back(mesh.rows_of(mode));
  }
  for (WrapLandmark& landmark : small.landmarks) {
    Index nearest = 0;
    (small.rest.rowwise() - rest.row(landmark.vertex)).rowwise().squaredNorm().minCoeff(&nearest);
    const Eigen::Vector3d beside =
        (small.rest.row(nearest) - rest.row(landmark.vertex)).transpose();
    landmark.vertex = static_cast<std::uint32_t>(nearest);
    landmark.scan_position += pose.scale * (pose.rotation * beside);
  }
  return small;
}

Similarity first_pose(const SkinMesh& bent, const Positions& rest,
                      const WrapTemplate& wrap_template, const ScanSurface& surface,
                      const std::vector<WrapLandmark>& landmarks,
                      const std::optional<PoseHint>& hint) {
  if (landmarks.size() >= kMinLandmarks) {
    refuse_mirrored_landmarks(rest, landmarks);
    refuse_swapped_pair(rest, landmarks);
    return pose_of_landmarks(rest, landmarks);
  }
  if (!hint) {
    throw InvalidInput(concat("expected at least ", kMinLandmarks,
                              " landmarks on template and scan, or which way the scan looks "
                              "(--scan-up, --scan-front), found ",
                              landmarks.size(), " landmarks"));
  }
  return guess_pose(bent, wrap_template.reduced_skin ? bent.rows_of(rest) : rest,
                    wrap_template.axes, surface, *hint, wrap_template.face_match);
}

void refuse_no_pose(const Similarity& pose) {
  if (std::isfinite(pose.scale) && std::isfinite(1 / pose.scale) && pose.translation.allFinite() &&
      pose.rotation.allFinite()) {
    return;
  }
  throw InvalidInput(
      "template and scan cannot be aligned; are the landmarks in different places, and is the scan "
      "a head?");
}

}  // namespace

ShapeModel skin_model(const ShapeModel& heads, const WrapTemplate& wrap_template) {
  const FoundMirror mirror = find_mirror(wrap_template.topology, wrap_template.components,
                                         heads.mean, wrap_template.axes.side());
  const ShapeModel both = mirror.partner_fraction() < kMinMirroredFraction
                              ? heads
                              : add_mirror_images(heads, mirror.map);
  ShapeModel of_skin{wrap_template.skin.rows_of(both.mean), {}};
  for (const Positions& mode : both.modes)
    of_skin.modes.push_back(wrap_template.skin.rows_of(mode));
  return of_skin;
}

static WrapResult wrap_centred(const WrapTemplate& wrap_template, const ShapeModel* model,
                               const Scan& scan, const std::vector<WrapLandmark>& all_landmarks,
                               const std::optional<PoseHint>& hint, const LipLine& closed_lips) {
  const std::optional<ReliefMatch> face = hint ? hint->face : std::nullopt;
  const SkinMesh& skin = wrap_template.skin;
  const SkinMesh& bent = wrap_template.reduced_skin ? wrap_template.reduced_skin->mesh : skin;
  std::vector<WrapLandmark> landmarks = landmarks_on_skin(skin, all_landmarks);
  const Positions rest = skin.rows_of(wrap_template.positions);
  WrapResult result;
  ShapeFit fit;
  std::optional<ReducedInputs> small;
  const ShapeModel* used = nullptr;
  {
    const ScanSurface surface(scan);
    fit.pose = first_pose(bent, rest, wrap_template, surface, landmarks, hint);
    if (wrap_template.reduced_skin) small = reduce(wrap_template, rest, model, landmarks, fit.pose);
    const auto& marks = small ? small->landmarks : landmarks;
    const ShapeModel alone{small ? small->rest : rest, {}};
    fit = fit_shape(bent, alone, surface, marks, fit);
    result.pose_residual_mm = fit.median_distance_mm;
    result.landmarks = residuals_of(rest, fit.pose, landmarks);
    if (model != nullptr) {
      used = small ? &*small->model : model;
      fit = fit_shape(
          bent, *used, surface, marks, fit,
          {.search_radii_mm = {20, 16, 12, 8, 6, 4}, .scan_weight = 6, .landmark_weight = 0.1});
    }
  }
  result.pose = fit.pose;
  refuse_no_pose(fit.pose);
  const Similarity back = inverse(fit.pose);
  const ScanSurface surface({back.apply(scan.positions), scan.triangles});
  move(landmarks, back);
  if (small) move(small->landmarks, back);
  const auto& marks = small ? small->landmarks : landmarks;
  Positions wrapped = small ? small->rest : rest;
  BendOptions bend;
  if (used != nullptr) {
    wrapped = regress_shape(bent, *used, used->evaluate(fit.coefficients), surface, marks);
    // After the model fit, differences are small and correspondences nearly correct. A tangential
    // weight would pull vertices along the surface to their closest points, which are less exact
    // than the correspondences of the model.
    bend = {.wavelengths_mm = {10, 5, 2.5},
            .first_round_tangential_weight = 0,
            .last_round_tangential_weight = 0.05,
            .first_round_landmark_weight = 2,
            .last_round_landmark_weight = 1.5};
  }
  wrapped =
      bend_skin(bent, wrapped, surface, marks, tied_lips(wrap_template, closed_lips, rest), bend);
  if (small) {
    repair_folded_triangles(bent, small->rest, wrapped);
    wrapped = rest + wrap_template.reduced_skin->interpolate(wrapped - small->rest, skin);
  }
  wrapped = follow_detail(skin, rest, wrapped, surface,
                          small ? wrap_template.reduced_skin->smoothing_steps : 0);
  result.folded_triangle_count = repair_folded_triangles(skin, rest, wrapped);
  add_final(wrapped, landmarks, result.landmarks);
  measure(wrapped, surface, result);
  if (face && wrap_template.face_match) {
    Index between = 0;
    (rest.rowwise() - wrap_template.face_match->eye_midpoint.transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&between);
    result.eye_midpoint_difference_mm =
        (row3(wrapped, between) - apply_similarity(back, face->eye_midpoint)).norm();
  }

  result.positions = wrap_template.positions;
  for (Index v = 0; v < wrapped.rows(); ++v) {
    result.positions.row(skin.vertices[static_cast<std::size_t>(v)]) = wrapped.row(v);
  }
  const HeadSet faces{wrap_template.topology, {}, {{"template", wrap_template.positions}}};
  PartFollower(faces, wrap_template.parts, wrap_template.axes).move_parts(0, result.positions);
  return result;
}

WrapResult wrap(const WrapTemplate& wrap_template, const ShapeModel* model, const Scan& scan,
                const std::vector<WrapLandmark>& landmarks, const std::optional<PoseHint>& hint,
                const LipLine& closed_lips) {
  const CentredScan moved = centre_scan(scan, landmarks);
  std::optional<PoseHint> standing = hint;
  const auto picked = std::ranges::count(landmarks, false, &WrapLandmark::is_found_by_program);
  if (standing && picked >= static_cast<std::ptrdiff_t>(kMinLandmarks)) {
    standing->face.reset();
  } else if (standing && !standing->face) {
    standing->face = find_scan_face(scan, hint);
  }
  if (standing && standing->face) standing->face->eye_midpoint -= moved.box_centre;
  WrapResult result =
      wrap_centred(wrap_template, model, moved.scan, moved.landmarks, standing, closed_lips);
  result.pose.translation += moved.box_centre;
  return result;
}

WrapResult wrap_checked(const WrapTemplate& wrap_template, const ShapeModel* model,
                        const std::vector<FaceFeature>& features, const Scan& scan,
                        const std::vector<WrapLandmark>& all_landmarks,
                        const std::optional<PoseHint>& hint) {
  const auto lowest_agreement = [](const WrapResult& result) {
    double lowest = 1;
    for (const FeatureCheck& feature : result.features)
      lowest = std::min(lowest, feature.agreement());
    return lowest;
  };
  const auto wrapped_with = [&](const std::vector<WrapLandmark>& landmarks,
                                const LipLine& closed_lips) {
    WrapResult result = wrap(wrap_template, model, scan, landmarks, hint, closed_lips);
    const std::vector<ReliefCorrelation> correlations =
        relief_correlations(wrap_template, features, result.positions);
    for (std::size_t i = 0; i < features.size(); ++i) {
      result.features.push_back({features[i].name, correlations[i], features[i].skin_vertices,
                                 find_scan_lip_line(wrap_template, features[i].lip_line,
                                                    result.positions, scan, result.pose)});
    }
    return result;
  };
  WrapResult best = wrapped_with(all_landmarks, {});
  // All automatically found landmarks of a feature may be wrong in the same way, for example if the
  // landmarks of the mouth lie in the crease above the chin. The error shows only in a fit that
  // does not use these landmarks.
  const auto is_of_questioned_feature = [&, checks = best.features](const WrapLandmark& landmark) {
    const std::uint32_t row = index_in_list(wrap_template.skin.vertices, landmark.vertex);
    return std::ranges::any_of(checks, [&](const FeatureCheck& feature) {
      return !feature.is_high() && std::ranges::binary_search(feature.skin_vertices, row);
    });
  };
  std::vector<WrapLandmark> landmarks = all_landmarks;
  for (const bool drops_all : {false, true}) {
    if (std::ranges::all_of(best.features, &FeatureCheck::is_high)) break;
    const std::size_t dropped = std::erase_if(landmarks, [&](const WrapLandmark& landmark) {
      return landmark.is_found_by_program && (drops_all || is_of_questioned_feature(landmark));
    });
    if (dropped == 0) continue;
    WrapResult other = wrapped_with(landmarks, {});
    if (lowest_agreement(other) <= lowest_agreement(best)) continue;
    for (const WrapLandmark& landmark : all_landmarks) {
      if (std::ranges::find(landmarks, landmark.name, &WrapLandmark::name) == landmarks.end()) {
        other.dropped_landmarks.push_back(landmark.name);
      }
    }
    best = std::move(other);
  }
  // On a closed mouth, the wrapped lips come apart if they are drawn to skin above and below the
  // scan's lips. Then tie them together.
  for (std::size_t i = 0; i < features.size(); ++i) {
    const LipLine& line = features[i].lip_line;
    const double gap = lip_gap_increase(wrap_template, line, best.positions);
    const auto& scan_line = best.features[i].scan_lip_line;
    if (!scan_line || !scan_line->is_closed || gap <= kMaxLipGapMm) continue;
    std::vector<WrapLandmark> used = all_landmarks;
    std::erase_if(used, [&](const WrapLandmark& landmark) {
      return std::ranges::find(best.dropped_landmarks, landmark.name) !=
             best.dropped_landmarks.end();
    });
    WrapResult closed = wrapped_with(used, line);
    if (lip_gap_increase(wrap_template, line, closed.positions) >= gap ||
        (closed.features[i].is_doubtful() && !best.features[i].is_doubtful())) {
      continue;
    }
    closed.dropped_landmarks = std::move(best.dropped_landmarks);
    best = std::move(closed);
  }
  return best;
}

std::map<std::string, double> cross_validate_wrap(const WrapTemplate& wrap_template,
                                                  const ShapeModel* model, const Scan& scan,
                                                  const std::vector<WrapLandmark>& landmarks,
                                                  const std::optional<PoseHint>& hint) {
  constexpr std::size_t kOneByOne = 12, kFolds = 4;
  std::map<std::string, double> unseen;
  if (!hint && landmarks.size() <= kMinLandmarks) return unseen;
  const std::size_t folds = landmarks.size() < kOneByOne ? landmarks.size() : kFolds;
  for (std::size_t fold = 0; fold < folds; ++fold) {
    std::vector<WrapLandmark> known, left_out;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      (i % folds == fold ? left_out : known).push_back(landmarks[i]);
    }
    const WrapResult result = wrap(wrap_template, model, scan, known, hint);
    const Similarity back = inverse(result.pose);
    for (const WrapLandmark& landmark : left_out) {
      unseen[landmark.name] =
          (row3(result.positions, landmark.vertex) - apply_similarity(back, landmark.scan_position))
              .norm();
    }
  }
  return unseen;
}

}  // namespace crowdface
