// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/scan_faults.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "crowdface/core/selection.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/mesh/vector3.h"
#include "crowdface/parts/eye_socket.h"
#include "crowdface/parts/point_grid.h"
#include "crowdface/parts/skin_contacts.h"

namespace crowdface {
namespace {

// An eye counts as closed if its lids are open less than this fraction of the template's lid
// opening.
constexpr double kClosed = 0.4;
// half width, in eyeball radii, of the region in which the opening of the lids is measured
constexpr double kMiddle = 0.4;
// in an open mouth, the lips are farther apart than on the template by more than this length
constexpr double kOpenMouthMm = 3;
constexpr double kHairMm = 10;  // without hair, the skull differs from the template's by less
constexpr double kMaxFar = 0.05;
constexpr std::size_t kMin = 20;  // least number of vertices in a region

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const std::size_t rank = values.size() / 2;
  return nth_smallest(std::move(values), rank);
}

/// Height of the upper lid above the lower lid at the middle of an eye.
std::optional<double> lid_opening(const Lids& lids, const ComponentShape& ball,
                                  const HeadAxes& axes, const Positions& rest,
                                  const Positions& positions) {
  std::vector<double> upper, lower;
  for (std::size_t i = 0; i < lids.rim.size(); ++i) {
    const std::uint32_t v = lids.vertices[lids.rim[i]];
    if (std::abs((row3(rest, v) - ball.centre).dot(axes.side())) > kMiddle * ball.radius) continue;
    (lids.is_upper[i] ? upper : lower).push_back(row3(positions, v).dot(axes.up));
  }
  const auto above = median(upper), below = median(lower);
  if (!above || !below) return std::nullopt;
  return *above - *below;
}

void look_at_eyes(const WrapTemplate& wrap_template, const WrapResult& result,
                  std::vector<std::string>& faults) {
  for (const Part& part : wrap_template.parts.parts) {
    if (!part.is_eyeball) continue;
    const ComponentShape& ball = wrap_template.parts.shapes[part.ball_component];
    const Lids lids =
        find_lids(wrap_template.positions, PointGrid(wrap_template.positions, part.vertices),
                  ball.centre, ball.radius, wrap_template.axes, wrap_template.skin.vertices);
    const auto before = lid_opening(lids, ball, wrap_template.axes, wrap_template.positions,
                                    wrap_template.positions);
    const auto after =
        lid_opening(lids, ball, wrap_template.axes, wrap_template.positions, result.positions);
    if (!before || !after || *after > kClosed * *before) continue;
    faults.push_back(concat("an eye seems to be closed: its lids are ", format_fixed(*after, 1),
                            " mm apart, the template's ", format_fixed(*before, 1),
                            "; scans need open eyes"));
  }
}

void look_at_mouth(const WrapTemplate& wrap_template, const WrapResult& result,
                   const SkinRegions& regions, std::vector<std::string>& faults) {
  std::vector<std::uint32_t> of_mouth;
  for (std::uint32_t v = 0; v < wrap_template.skin.vertex_count(); ++v) {
    if (regions.contains(v, "mouth")) of_mouth.push_back(wrap_template.skin.vertices[v]);
  }
  const HeadSet faces{wrap_template.topology, {}, {{"template", wrap_template.positions}}};
  const SkinContacts contacts(faces, wrap_template.adjacency, of_mouth);
  const std::vector<double> before = contacts.gaps(wrap_template.positions),
                            after = contacts.gaps(result.positions);
  std::vector<double> wider;
  for (std::size_t i = 0; i < contacts.size(); ++i) wider.push_back(after[i] - before[i]);
  if (wider.empty()) return;
  // Some contacts lie beside the lips and stay closed. Therefore use the value that a third of the
  // contacts exceed, and not the median.
  const std::size_t rank = wider.size() * 2 / 3;
  if (const double by = nth_smallest(std::move(wider), rank); by > kOpenMouthMm) {
    faults.push_back(concat("the mouth seems to be open: lips are ", format_fixed(by, 1),
                            " mm farther apart than the template's; scans need a closed mouth"));
  }
}

void look_at_hair(const WrapTemplate& wrap_template, const WrapResult& result,
                  const SkinRegions& regions, std::vector<std::string>& faults) {
  const Positions rest = wrap_template.skin.rows_of(wrap_template.positions),
                  wrapped = wrap_template.skin.rows_of(result.positions);
  std::vector<std::uint32_t> face, skull;
  for (std::uint32_t v = 0; v < regions.region_of_vertex.size(); ++v) {
    if (wrap_template.skin.ambient_visibility[v] <= kVisibleSkinThreshold || result.lacks_data[v])
      continue;
    if (regions.contains(v, "nose") || regions.contains(v, "mouth")) face.push_back(v);
    if (regions.contains(v, "brow")) skull.push_back(v);
  }
  if (face.size() < kMin || skull.size() < kMin) return;
  const Similarity faces_meet =
      fit_similarity(rest(face, kAllColumns), wrapped(face, kAllColumns), ScaleFit::kUniform);
  const Positions placed = faces_meet.apply(rest);
  const Positions normals = vertex_normals_or_zero(wrap_template.skin.triangles, placed);
  std::vector<double> out;
  std::size_t far = 0;
  for (const std::uint32_t v : skull) {
    out.push_back((row3(wrapped, v) - row3(placed, v)).dot(row3(normals, v)));
    if (result.distance_mm(v) > kFarFromScanMm) ++far;
  }
  const double share = static_cast<double>(far) / static_cast<double>(skull.size());
  const double above = median(std::move(out)).value_or(0);
  if (above <= kHairMm && share <= kMaxFar) return;
  std::vector<std::string> signs;
  if (above > kHairMm) {
    signs.push_back(
        concat("the scan is ", format_fixed(above, 0), " mm outside the template's head"));
  }
  if (share > kMaxFar) {
    signs.push_back(concat(format_fixed(100 * share, 1), " % of the wrapped skin is more than ",
                           kFarFromScanMm, " mm from the scan"));
  }
  faults.push_back(concat("the scan seems to show hair or a hat: above the brows ",
                          join(signs, ", and "), "; exclude this area with --ignore"));
}

}  // namespace

bool SkinRegions::contains(std::uint32_t vertex, const std::string& name) const {
  return vertex < region_of_vertex.size() && names[region_of_vertex[vertex]] == name;
}

std::vector<std::string> scan_faults(const WrapTemplate& wrap_template, const WrapResult& result,
                                     const SkinRegions& regions) {
  std::vector<std::string> faults;
  look_at_eyes(wrap_template, result, faults);
  if (!regions.region_of_vertex.empty()) {
    look_at_mouth(wrap_template, result, regions, faults);
    look_at_hair(wrap_template, result, regions, faults);
  }
  return faults;
}

}  // namespace crowdface
