// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/core/version.h"
#include "crowdface/io/image.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/render/contact_sheet.h"
#include "crowdface/render/face_renderer.h"
#include "crowdface/render/heat_colours.h"
#include "crowdface/wrap/scan_surface.h"

namespace crowdface {
namespace {

// largest accepted median distance between corresponding landmarks of template and scan after the
// best similarity fit
constexpr double kMaxMedianMm = 15;
constexpr double kMaxDistanceMm = 3;  // 95th percentile over the visible skin
constexpr double kMaxFarShare = 0.02, kMaxWithoutData = 0.15, kMinWithData = 0.02;
constexpr std::size_t kFewHeads = 8;

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
  return nth_smallest(std::move(values), rank);
}

bool seen(const WrapTemplate& wrap_template, Index v) {
  return wrap_template.skin.ambient_visibility[static_cast<std::size_t>(v)] > kVisibleSkinThreshold;
}

/// Distances to the scan, for all visible skin vertices that have scan data.
/// \param regions  if null, the function uses the vertices of the whole skin
/// \param region   index into `regions->names`: the function uses the vertices of this region
std::vector<double> visible_distances(const WrapTemplate& wrap_template, const WrapResult& result,
                                      const SkinRegions* regions = nullptr,
                                      std::size_t region = 0) {
  std::vector<double> distances;
  for (Index v = 0; v < result.distance_mm.size(); ++v) {
    if (regions != nullptr && regions->region_of_vertex[static_cast<std::size_t>(v)] != region)
      continue;
    if (seen(wrap_template, v) && !result.lacks_data[static_cast<std::size_t>(v)]) {
      distances.push_back(result.distance_mm(v));
    }
  }
  return distances;
}

double share_far(const std::vector<double>& distances) {
  const auto far = std::count_if(distances.begin(), distances.end(),
                                 [](double distance) { return distance > kFarFromScanMm; });
  return distances.empty() ? 0 : static_cast<double>(far) / static_cast<double>(distances.size());
}

/// Returns the end of a sentence that names the region with the largest fraction of skin far from
/// the scan, and this fraction: for example ", most of it on the brow (12.5 %)". Empty if no region
/// has such skin.
std::string farthest_region(const WrapTemplate& wrap_template, const WrapResult& result,
                            const SkinRegions& regions) {
  double most = 0;
  std::string text;
  for (std::size_t r = 0; r < regions.names.size(); ++r) {
    const double share = share_far(visible_distances(wrap_template, result, &regions, r));
    if (share <= most) continue;
    most = share;
    text =
        concat(", most of it on the ", regions.names[r], " (", format_fixed(100 * share, 1), " %)");
  }
  return text;
}

nlohmann::ordered_json rounded(double value) {
  return nlohmann::ordered_json::parse(format_fixed(value, 3));
}

nlohmann::ordered_json spread_json(const std::vector<double>& values) {
  return {{"median", rounded(percentile(values, 0.5))},
          {"95 %", rounded(percentile(values, 0.95))}};
}

constexpr double kMaxFaceOffMm = 25;

constexpr int kSidePx = 320;
constexpr double kScaleEndMm = 2;  // end of the heat map's scale
constexpr std::array<View, 3> kViews = {View::kFront, View::kThreeQuarter, View::kProfile};

/// Render settings for the surfaces: eyeballs are shown as eyes, lashes and tear lines are hidden.
Surfaces surfaces_of(const WrapTemplate& wrap_template) {
  std::vector<SurfaceKind> of_component(wrap_template.parts.classes.size(), SurfaceKind::kSkin);
  for (const Part& part : wrap_template.parts.parts) {
    for (const std::uint32_t c : part.components) {
      of_component[c] = part.part_class == PartClass::kBound          ? SurfaceKind::kHidden
                        : part.is_eyeball && c == part.ball_component ? SurfaceKind::kEye
                        : part.is_eyeball                             ? SurfaceKind::kHidden
                                                                      : SurfaceKind::kTeeth;
    }
  }
  Surfaces surfaces;
  for (Index f = 0; f < wrap_template.topology.face_count(); ++f) {
    surfaces.kinds.push_back(
        of_component[wrap_template.components
                         .component_of_vertex[wrap_template.topology.face(f)[0]]]);
  }
  return surfaces;
}

/// Returns colours in which the doubtful features are red; nothing if no feature is doubtful.
std::optional<VertexColours> doubt_colours(const WrapTemplate& wrap_template,
                                           const WrapResult& result) {
  if (std::ranges::none_of(result.features,
                           [](const FeatureCheck& feature) { return feature.is_doubtful(); }))
    return std::nullopt;
  Eigen::VectorXd doubtful = Eigen::VectorXd::Zero(wrap_template.topology.vertex_count);
  for (const FeatureCheck& feature : result.features) {
    if (!feature.is_doubtful()) continue;
    for (const std::uint32_t v : feature.skin_vertices)
      doubtful(wrap_template.skin.vertices[v]) = 1;
  }
  return mask_colours(doubtful, heat_colour(1));
}

}  // namespace

WrapDistances measure_distances(const WrapTemplate& wrap_template, const WrapResult& result) {
  const std::vector<double> distances = visible_distances(wrap_template, result);
  return {percentile(distances, 0.5), percentile(distances, 0.95)};
}

double fraction_without_data(const WrapTemplate& wrap_template, const WrapResult& result) {
  Index visible = 0, without = 0;
  for (Index v = 0; v < result.distance_mm.size(); ++v) {
    if (!seen(wrap_template, v)) continue;
    ++visible;
    if (result.lacks_data[static_cast<std::size_t>(v)]) ++without;
  }
  return visible == 0 ? 0 : static_cast<double>(without) / static_cast<double>(visible);
}

std::vector<std::string> doubtful_part_warnings(const WrapTemplate& wrap_template,
                                                const WrapResult& result) {
  std::vector<std::string> warnings;
  for (const FeatureCheck& feature : result.features) {
    if (!feature.is_doubtful()) continue;
    const double up = feature.scan_lip_line ? feature.scan_lip_line->offset_mm : 0;
    const std::string reason =
        feature.scan_lip_line
            ? concat("the scan's lips meet ", format_fixed(std::abs(up), 1), " mm ",
                     up > 0 ? "above" : "below", " the lips of the wrapped head")
            : concat("on the wrapped head it does not look like the template's (correlation ",
                     format_fixed(feature.correlation.correlation_at_feature, 2),
                     "; a few mm above or below ",
                     format_fixed(feature.correlation.best_correlation_nearby, 2), ")");
    warnings.push_back(concat("the ", feature.name, " is doubtful: ", reason,
                              ": check the picture, where it is red, and pick landmarks there"));
  }
  for (const LandmarkResidual& landmark : result.landmarks) {
    if (!landmark.is_outlier) continue;
    if (landmark.is_found_by_program) {
      warnings.push_back(concat("landmark ", quoted(landmark.name),
                                ", detected from the shape, ends ",
                                format_fixed(landmark.final_distance_mm, 1),
                                " mm from its detected place, far more than the others: if the "
                                "picture is wrong, pick it"));
      continue;
    }
    warnings.push_back(concat(
        "landmark ", quoted(landmark.name), " ends ", format_fixed(landmark.final_distance_mm, 1),
        " mm from where it was picked, far more than the others: check it on template and scan"));
  }
  const auto picked =
      std::ranges::count(result.landmarks, false, &LandmarkResidual::is_found_by_program);
  if (!result.eye_midpoint_difference_mm && picked < static_cast<std::ptrdiff_t>(kMinLandmarks)) {
    warnings.push_back(concat(
        "no face was recognised on the ",
        wrap_template.face_match
            ? "scan"
            : concat("template (",
                     why_no_face_found(wrap_template.topology, head_shape(wrap_template),
                                       wrap_template.axes),
                     ')'),
        ", so the place of the face is not verified: check the picture, or pick four landmarks or "
        "more"));
  }
  return warnings;
}

std::vector<std::string> wrap_warnings(const WrapTemplate& wrap_template, const WrapResult& result,
                                       const SkinRegions& regions, std::size_t model_head_count) {
  std::vector<std::string> warnings = doubtful_part_warnings(wrap_template, result);
  const std::vector<std::string> faults = scan_faults(wrap_template, result, regions);
  warnings.insert(warnings.end(), faults.begin(), faults.end());
  const double share = share_far(visible_distances(wrap_template, result));
  if (share > kMaxFarShare && faults.empty()) {
    warnings.push_back(concat(format_fixed(100 * share, 1), " % of the skin is more than ",
                              kFarFromScanMm, " mm off the scan",
                              farthest_region(wrap_template, result, regions),
                              ": exclude with --ignore what is not skin, or pick landmarks there"));
  }
  if (const double lacking = fraction_without_data(wrap_template, result);
      lacking > kMaxWithoutData) {
    warnings.push_back(concat("the scan has no data for ", format_fixed(100 * lacking, 0),
                              " % of the skin; the shape there is estimated"));
  }
  if (result.folded_triangle_count > 0) {
    warnings.push_back(concat(result.folded_triangle_count,
                              result.folded_triangle_count == 1
                                  ? " triangle of the wrapped head is"
                                  : " triangles of the wrapped head are",
                              " flipped: check the head there, or pick landmarks nearby"));
  }
  if (model_head_count > 0 && model_head_count < kFewHeads) {
    warnings.push_back(concat("a model of ", model_head_count,
                              " heads says little more than their mean; expected ", kFewHeads,
                              " or more"));
  }
  return warnings;
}

void refuse_bad_wrap(const WrapTemplate& wrap_template, const WrapResult& result,
                     const SkinRegions& regions) {
  if (fraction_without_data(wrap_template, result) > 1 - kMinWithData) {
    throw InvalidInput(
        "the scan has no data for the skin: is it a head, and are the landmarks, or --scan-up and "
        "--scan-front, correct?");
  }
  std::vector<double> residuals;
  for (const LandmarkResidual& landmark : result.landmarks)
    residuals.push_back(landmark.pose_distance_mm);
  if (const double median = percentile(residuals, 0.5); !(median <= kMaxMedianMm)) {
    throw InvalidInput(
        concat("landmarks of template and scan do not match: half of them stay more than ",
               format_fixed(median, 1), " mm apart, expected less than ", kMaxMedianMm,
               "; are left and right swapped, or vertices counted from 1?"));
  }
  if (const double far = measure_distances(wrap_template, result).percentile_95_mm;
      !(far <= kMaxDistanceMm)) {
    throw InvalidInput(concat("5 % of the skin stays more than ", format_fixed(far, 1),
                              " mm off the scan, expected less than ", kMaxDistanceMm,
                              farthest_region(wrap_template, result, regions),
                              result.landmarks.empty() ? ": pick four landmarks or more"
                                                       : ": check the landmarks, pick more of them",
                              ", or exclude with --ignore what is not skin on the scan"));
  }
  if (result.eye_midpoint_difference_mm && *result.eye_midpoint_difference_mm > kMaxFaceOffMm) {
    throw InvalidInput(concat("the template's face ended ",
                              format_fixed(*result.eye_midpoint_difference_mm, 0),
                              " mm from the face of the scan: pick four landmarks or more "
                              "(crowdface wrap --pick), or check --scan-up and --scan-front"));
  }
}

std::string format_wrap_report(const WrapFacts& facts, const WrapTemplate& wrap_template,
                               const WrapResult& result, const SkinRegions& regions,
                               const std::vector<std::string>& warnings) {
  nlohmann::ordered_json report;
  report["crowdface"] = kVersion;
  report["inputs"] = facts.inputs_digest;
  report["mesh"] = facts.mesh_digest;
  report["template"] = facts.template_file;
  report["scan"] = facts.scan_file;
  report["scale"] = result.pose.scale;
  report["output_scale"] = facts.output_scale;
  report["turned_degrees"] = rounded(result.pose.angle_degrees());
  report["pose_residual_mm"] = rounded(result.pose_residual_mm);
  report["distance_mm"] = spread_json(visible_distances(wrap_template, result));
  for (std::size_t r = 0; r < regions.names.size(); ++r) {
    report["regions_mm"][regions.names[r]] =
        spread_json(visible_distances(wrap_template, result, &regions, r));
  }
  report["without_data"] = rounded(fraction_without_data(wrap_template, result));
  if (facts.share_without_scan) report["textures_filled"] = rounded(*facts.share_without_scan);
  report["flipped_triangles"] = result.folded_triangle_count;
  report["landmarks"] = nlohmann::ordered_json::array();
  for (const LandmarkResidual& landmark : result.landmarks) {
    report["landmarks"].push_back({{"name", landmark.name},
                                   {"pose_mm", rounded(landmark.pose_distance_mm)},
                                   {"final_mm", rounded(landmark.final_distance_mm)},
                                   {"outlier", landmark.is_outlier}});
    if (landmark.is_found_by_program) {
      report["landmarks"].back()["detected_within_mm"] = rounded(landmark.error_mm);
    }
    for (const auto& [key, all] : {std::pair{"left_out_mm", &facts.cross_validated_pose_errors_mm},
                                   std::pair{"unseen_mm", &facts.cross_validated_wrap_errors_mm}}) {
      const auto found = all->find(landmark.name);
      if (found != all->end()) report["landmarks"].back()[key] = rounded(found->second);
    }
  }
  if (!facts.cross_validated_wrap_errors_mm.empty()) {
    std::vector<double> all;
    for (const auto& [name, mm] : facts.cross_validated_wrap_errors_mm) all.push_back(mm);
    report["correspondence_mm"] = spread_json(all);
  }
  for (const FeatureCheck& feature : result.features) {
    report["features"][feature.name] = rounded(feature.agreement());
  }
  if (!result.dropped_landmarks.empty()) report["dropped_landmarks"] = result.dropped_landmarks;
  report["warnings"] = warnings;
  return report.dump(2) + "\n";
}

std::string wrap_picture(const WrapTemplate& wrap_template, const Scan& scan,
                         const WrapResult& result, const HeadFrame& frame,
                         const std::string& title) {
  const Positions standing = inverse(result.pose).apply(scan.positions);
  const std::array<const Positions*, 1> heads = {&result.positions};
  const std::vector<Camera> cameras =
      fit_cameras(heads, frame, kViews, {.bottom_cut_fraction = 0.1});
  const RenderOptions options{.size_px = kSidePx, .front = frame.front};
  const Topology scan_topology = topology_of(scan.triangles, scan.positions.rows());
  const FaceRenderer of_scan(scan_topology, options, {}, &standing),
      of_head(wrap_template.topology, options, surfaces_of(wrap_template), &result.positions);
  Eigen::VectorXd distances = Eigen::VectorXd::Zero(wrap_template.topology.vertex_count);
  for (std::size_t i = 0; i < wrap_template.skin.vertices.size(); ++i) {
    distances(wrap_template.skin.vertices[i]) = result.distance_mm(static_cast<Index>(i));
  }
  const VertexColours colours = heat_colours(distances, kScaleEndMm);
  const std::optional<VertexColours> doubts = doubt_colours(wrap_template, result);
  std::vector<Rgb8Image> scans, wrapped, heat;
  for (const Camera& camera : cameras) {
    scans.push_back(of_scan.render(standing, camera));
    wrapped.push_back(of_head.render(result.positions, camera, doubts ? &*doubts : nullptr));
    heat.push_back(of_head.render(result.positions, camera, &colours));
  }
  const std::vector<SheetCell> cells = {
      {joined_pictures(scans), "scan"},
      {joined_pictures(wrapped),
       doubts ? "wrapped template, doubtful parts red" : "wrapped template"},
      {joined_pictures(heat), "distance to the scan"}};
  const Rgb8Image sheet =
      contact_sheet(cells, {.columns = 1, .title = title, .legend = HeatLegend{kScaleEndMm, "mm"}});
  return encode_png(sheet.width, sheet.height, 3, sheet.pixels);
}

}  // namespace crowdface
