// SPDX-License-Identifier: Apache-2.0
#include "crowdface/synth/hair_form.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "crowdface/core/smooth_step.h"
#include "crowdface/synth/ear.h"
#include "crowdface/synth/hair.h"
#include "crowdface/synth/hair_picture.h"
#include "crowdface/synth/layout.h"
#include "crowdface/synth/mean_head.h"
#include "crowdface/synth/sculpture.h"

namespace crowdface::synth {
namespace {

using Eigen::Vector3d;

constexpr Index kCapLayout = 12'000;
constexpr double kCapEdge = 0.45;    // centimetres, about its quads' size
constexpr double kRim = 0.55;        // centimetres by which thin hair runs beyond the edge
constexpr double kStripWidth = 1.5;  // centimetres of the cap that a strip is laid over

/// To and fro between 0 and 1, so that a strip meets itself.
double to_and_fro(double x) {
  const double whole = std::floor(x), part = x - whole;
  return std::fmod(std::abs(whole), 2.0) < 0.5 ? part : 1 - part;
}

/// Centimetres across the hair, as it is mostly combed.
double across_hair(const HairCut& cut, const Vector3d& p) {
  if (cut.back >= 0.8)
    return p.x() + (p.x() > 0 ? -p.y() : p.y()) * smooth_step(3, 6, std::abs(p.x()));
  return p.z() - std::abs(p.x()) * smooth_step(-3, -7, p.z());
}

}  // namespace

double head_distance(const Vector3d& p) {
  const Vector3d radii(1.0, 3.0, 2.0);
  const Vector3d q = (Vector3d(std::abs(p.x()), p.y(), p.z()) - ear_centre()).cwiseQuotient(radii);
  return std::min(skin_distance(p), (q.norm() - 1) * radii.x());
}

Vector3d away_from_head(const Vector3d& p) {
  return rise(head_distance, p, 1e-3).normalized();
}

double HairForm::within(const Vector3d& p) const {
  const double above = above_hairline(p, cut_.female), height = p.y() + 0.25 * std::max(0.0, p.z());
  if (cut_.crown_bald) return std::min(above, 6.2 - height);
  return cut_.sides > 0 ? above : std::min(above, height - 4.3);
}

double HairForm::stand_off(const Vector3d& p) const {
  const double rises = smooth_step(0, 2.6, within(p)), top = smooth_step(3, 8, p.y());
  if (cut_.layers > 1) return 0.5 * cut_.volume * rises * (0.45 + 0.35 * smooth_step(1, 7, p.y()));
  const bool parted = cut_.back < 0.8 && !cut_.has_fringe();
  const double parting =
      smooth_step(2.2, 0, std::abs(p.x() - cut_.parting)) * smooth_step(-6, -2, p.z());
  return 0.7 * cut_.volume * rises * (0.55 + 0.45 * top) * (parted ? 1 - 0.55 * parting : 1);
}

Vector3d HairForm::combed(const Vector3d& p) const {
  // A parting ends at the crown; behind it hair falls as it grows.
  const double wide = cut_.back >= 0.8 ? 5 : 0.25 + 5 * smooth_step(-2, -7, p.z());
  const double side = std::clamp((p.x() - cut_.parting) / wide, -1.0, 1.0);
  Vector3d way(cut_.sideways * side, -0.15, -cut_.back);
  if (cut_.has_fringe()) {
    const double ahead = smooth_step(0, 2.5, p.z()) * smooth_step(6.0, 4.6, std::abs(p.x()));
    way += ahead * (Vector3d(0.1 * p.x() / 5, -0.3, 1.2) - way);
  }
  const Vector3d normal = away_from_head(p);
  way -= way.dot(normal) * normal;
  return way.norm() > 1e-6 ? Vector3d(way.normalized()) : way;
}

Mesh hair_cap(const HairCut& cut) {
  const Layout layout = make_layout(kCapLayout);
  const HairForm form(cut);
  Mesh cap;
  std::vector<Vector3d> points;
  std::vector<Eigen::Vector2d> uvs;
  std::vector<std::uint32_t> place(layout.addresses.size(), kNoIndex);
  for (std::size_t v = 0; v < place.size(); ++v) {
    const SkinPoint skin = mean_skin_with_sockets(layout.addresses[v]);
    const double within = form.within(skin.position);
    if (skin.relief < 0.5 || within < -kRim - kCapEdge) continue;
    place[v] = static_cast<std::uint32_t>(points.size());
    points.emplace_back(skin.position + (0.03 + form.stand_off(skin.position)) * skin.normal);
    const double u = 0.03 + 0.94 * to_and_fro(across_hair(cut, skin.position) / kStripWidth);
    const double v_of_tips = 0.02, inner = 0.75;
    uvs.emplace_back((kCardStrips + u) / kHairStrips,
                     v_of_tips + inner * std::clamp((within + kRim) / 1.7, 0.0, 1.0));
  }
  for (Index f = 0; f < layout.topology.face_count(); ++f) {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t v : layout.topology.face(f)) corners.push_back(place[v]);
    if (std::ranges::find(corners, kNoIndex) == corners.end())
      cap.topology.add_face(corners, corners);
  }
  cap.topology.vertex_count = static_cast<Index>(points.size());
  cap.positions.resize(cap.topology.vertex_count, 3);
  cap.uvs.resize(cap.topology.vertex_count, 2);
  for (std::size_t v = 0; v < points.size(); ++v) {
    cap.positions.row(static_cast<Index>(v)) = points[v].transpose();
    cap.uvs.row(static_cast<Index>(v)) = uvs[v].transpose();
  }
  return cap;
}

}  // namespace crowdface::synth
