// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/eyeballs.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "crowdface/mesh/disjoint_sets.h"
#include "crowdface/render/perpendicular.h"

namespace crowdface {
namespace {

/// A smooth step in `x`: rises from 0 at edge − kIrisSoftness to 1 at edge + kIrisSoftness.
float smooth_step(float edge, float x) {
  const float t = std::clamp((x - edge + kIrisSoftness) / (2 * kIrisSoftness), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

}  // namespace

Eyeballs find_eyeballs(const Topology& topology, const std::vector<SurfaceKind>& kinds) {
  Eyeballs eyeballs;
  if (std::find(kinds.begin(), kinds.end(), SurfaceKind::kEye) == kinds.end()) return eyeballs;
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  DisjointSets groups(vertices);
  std::vector<bool> in_eye(vertices, false);
  for (Index f = 0; f < topology.face_count(); ++f) {
    if (kinds[static_cast<std::size_t>(f)] != SurfaceKind::kEye) continue;
    for (const std::uint32_t vertex : topology.face(f)) {
      in_eye[vertex] = true;
      groups.join(vertex, topology.face(f)[0]);
    }
  }
  eyeballs.eyeball_of_vertex.assign(vertices, Eyeballs::kNone);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    if (!in_eye[i]) continue;
    const std::uint32_t first = groups.root(i);
    eyeballs.eyeball_of_vertex[i] =
        first == i ? eyeballs.count++ : eyeballs.eyeball_of_vertex[first];
  }
  return eyeballs;
}

std::vector<EyeballSphere> eyeball_spheres(const Eyeballs& eyeballs,
                                           const std::vector<float>& points,
                                           const Eigen::Vector3f& gaze) {
  using Box = Eigen::AlignedBox3f;
  const auto [across, along] = tangent_basis(gaze);
  std::vector<Box> boxes(eyeballs.count);  // axes: across, along, gaze
  for (std::size_t i = 0; i < eyeballs.eyeball_of_vertex.size(); ++i) {
    if (eyeballs.eyeball_of_vertex[i] == Eyeballs::kNone) continue;
    const Eigen::Map<const Eigen::Vector3f> point(points.data() + 3 * i);
    boxes[eyeballs.eyeball_of_vertex[i]].extend(
        Eigen::Vector3f(point.dot(across), point.dot(along), point.dot(gaze)));
  }
  std::vector<EyeballSphere> eyes;
  for (const Box& box : boxes) {
    const Eigen::Vector3f middle = box.center();
    const Eigen::Vector3f half = box.sizes() / 2;
    eyes.push_back({middle.x() * across + middle.y() * along + middle.z() * gaze,
                    std::max(half.x(), half.y())});
  }
  return eyes;
}

LinearRgb eye_albedo(const EyeballSphere& eye, const Eigen::Vector3f& gaze,
                     const Eigen::Vector3f& point) {
  LinearRgb white = albedo_of(SurfaceKind::kEye);
  const Eigen::Vector3f from_centre = point - eye.centre;
  const float ahead = from_centre.dot(gaze);
  if (ahead <= 0 || eye.radius <= 0) return white;
  const float radius = (from_centre - ahead * gaze).norm() / eye.radius;
  // The iris is lightest next to the pupil and darkest at its rim.
  const float rim = std::clamp((radius - kPupilRadius) / (kIrisRadius - kPupilRadius), 0.0F, 1.0F);
  const LinearRgb iris = albedo_of(SurfaceKind::kIris) * (1.6F - 1.25F * rim * rim);
  const LinearRgb pupil = LinearRgb::Constant(0.008F);
  const LinearRgb inner = pupil + (iris - pupil) * smooth_step(kPupilRadius, radius);
  return inner + (white - inner) * smooth_step(kIrisRadius, radius);
}

}  // namespace crowdface
