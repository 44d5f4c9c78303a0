// SPDX-License-Identifier: Apache-2.0
#include "head_models/synth/hair_form.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crowdface/core/contains.h"
#include "crowdface/core/smooth_step.h"
#include "head_models/synth/ear.h"
#include "head_models/synth/hair.h"
#include "head_models/synth/hair_picture.h"
#include "head_models/synth/layout.h"
#include "head_models/synth/mean_head.h"
#include "head_models/synth/sculpture.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

constexpr Index kCapLayout = 12'000;
constexpr double kCapEdge = 0.45;    // size of the cap's quads, cm
constexpr double kRim = 0.5;         // width of sparse roots beyond the hairline, cm
constexpr double kFade = 1.9;        // width of the zone in which the cap becomes closed, cm
constexpr double kStripWidth = 1.5;  // width of the cap that one texture strip covers, cm

/// A triangle wave between 0 and 1, so that neighbouring copies of a strip match.
double triangle_wave(double x) {
  const double whole = std::floor(x), part = x - whole;
  return std::fmod(std::abs(whole), 2.0) < 0.5 ? part : 1 - part;
}

/// Returns the coordinate of a point along an axis at right angles to the main combing direction,
/// cm.
double across_hair(const HairCut& cut, const Vector3d& p) {
  if (cut.backward_combing >= 0.8)
    return p.x() + (p.x() > 0 ? -p.y() : p.y()) * smooth_step(3, 6, std::abs(p.x()));
  // On the forehead, the hairline runs from side to side. Hair is combed at right angles to the
  // hairline.
  const double ahead = smooth_step(1, 4, p.z()), x = std::abs(p.x());
  return (1 - ahead) * p.z() + (ahead - smooth_step(-3, -7, p.z())) * x;
}

/// Returns the texture coordinate v of the cap at a point whose distance from the hairline,
/// measured inwards, is `within` cm.
double v_at_distance_from_hairline(double within) {
  // Farther than kFade from its edge, the cap shows the part of the texture without strand tips.
  return 0.02 + 0.75 * std::clamp((within + kRim) / kFade, 0.0, 1.0);
}

}  // namespace

double head_distance(const Vector3d& p, bool has_wide_ears) {
  const Vector3d shift = has_wide_ears ? Vector3d(0.6, 0.2, -0.9) : Vector3d::Zero();
  const Vector3d radii = has_wide_ears ? Vector3d(1.5, 2.9, 2.3) : Vector3d(1.0, 3.0, 2.0);
  const Vector3d centre = ear_centre() + shift;
  const Vector3d q = (Vector3d(std::abs(p.x()), p.y(), p.z()) - centre).cwiseQuotient(radii);
  return std::min(skin_distance(p), (q.norm() - 1) * radii.x());
}

Vector3d head_distance_gradient(const Vector3d& p, bool has_wide_ears) {
  const auto distance = [&](const Vector3d& at) { return head_distance(at, has_wide_ears); };
  return central_differences(distance, p, 1e-3).normalized();
}

double distance_inside_hair(const HairCut& cut, const Vector3d& p) {
  const double above = height_above_hairline(p, cut.is_for_women, cut.recession),
               height = p.y() + 0.25 * std::max(0.0, p.z());
  if (cut.has_bald_crown) return std::min(above, 6.2 - height);
  return cut.side_length > 0 ? above : std::min(above, height - 4.3);
}

double hair_stand_off(const HairCut& cut, const Vector3d& p) {
  const double rises = smooth_step(0, 2.6, distance_inside_hair(cut, p)),
               top = smooth_step(3, 8, p.y());
  if (cut.layers > 1)
    return 0.5 * cut.volume_factor * rises * (0.45 + 0.35 * smooth_step(1, 7, p.y()));
  const double parting =
      smooth_step(2.2, 0, std::abs(p.x() - cut.parting_x)) * smooth_step(-6, -2, p.z());
  return 0.7 * cut.volume_factor * rises * (0.55 + 0.45 * top) *
         (cut.has_parting() ? 1 - 0.4 * parting : 1);
}

Vector3d combing_direction(const HairCut& cut, const Vector3d& p) {
  // `wide`: half the width, cm, of the strip in which the combing direction changes from one side
  // to the other. The strip is narrow at the parting and widens behind the crown.
  const double wide = cut.backward_combing >= 0.8 ? 5 : 0.25 + 5 * smooth_step(-2, -7, p.z());
  const double side = std::clamp((p.x() - cut.parting_x) / wide, -1.0, 1.0);
  Vector3d way(cut.sideways_combing * side, -0.15, -cut.backward_combing);
  if (cut.has_fringe()) {
    const double ahead = smooth_step(0, 2.5, p.z()) * smooth_step(6.0, 4.6, std::abs(p.x()));
    way += ahead * (Vector3d(0.1 * p.x() / 5, -0.3, 1.2) - way);
  }
  const Vector3d normal = head_distance_gradient(p);
  way -= way.dot(normal) * normal;
  return way.norm() > 1e-6 ? Vector3d(way.normalized()) : way;
}

Mesh HairMesh::to_mesh() && {
  const auto count = static_cast<Index>(points.size());
  topology.vertex_count = count;
  return {std::move(topology), Eigen::Map<const Positions>(points.front().data(), count, 3),
          Eigen::Map<const TextureCoordinates>(uvs.front().data(), count, 2)};
}

void add_hair_cap(const HairCut& cut, HairMesh& hair) {
  const Layout layout = make_layout(kCapLayout);
  std::vector<std::uint32_t> place(layout.lattice_points.size(), kNoIndex);
  for (std::size_t v = 0; v < place.size(); ++v) {
    const SkinPoint skin = mean_skin_with_sockets(layout.lattice_points[v]);
    const double within = distance_inside_hair(cut, skin.position);
    if (skin.relief_weight < 0.5 || within < -kRim - kCapEdge) continue;
    place[v] = static_cast<std::uint32_t>(hair.points.size());
    hair.points.emplace_back(skin.position +
                             (0.03 + hair_stand_off(cut, skin.position)) * skin.normal);
    const double u = 0.03 + 0.94 * triangle_wave(across_hair(cut, skin.position) / kStripWidth);
    hair.uvs.emplace_back((kCardStripCount + u) / kTextureStripCount,
                          v_at_distance_from_hairline(within));
  }
  for (Index f = 0; f < layout.topology.face_count(); ++f) {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t v : layout.topology.face(f)) corners.push_back(place[v]);
    if (!contains(corners, kNoIndex)) hair.topology.add_face(corners, corners);
  }
}

}  // namespace crowdface::synth
