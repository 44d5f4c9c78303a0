// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/vertex_colours.h"

#include <algorithm>
#include <array>

#include "crowdface/mesh/vector3.h"
#include "crowdface/render/eyeballs.h"
#include "crowdface/render/perpendicular.h"
#include "crowdface/render/shading.h"

namespace crowdface {
namespace {

// The colour-blind safe palette of Okabe & Ito (2008), without black and yellow.
constexpr std::array<std::array<float, 3>, 6> kPalette = {{{0.84F, 0.37F, 0.00F},
                                                           {0.00F, 0.45F, 0.70F},
                                                           {0.00F, 0.62F, 0.45F},
                                                           {0.80F, 0.47F, 0.65F},
                                                           {0.90F, 0.62F, 0.00F},
                                                           {0.34F, 0.71F, 0.91F}}};

bool is_painted(const Surfaces& surfaces, Eigen::Index face) {
  return !surfaces.polygon_colours.empty() &&
         surfaces.polygon_colours[static_cast<std::size_t>(face)];
}

}  // namespace

Eigen::Vector3f palette_colour(Eigen::Index k) {
  const auto& c = kPalette[static_cast<std::size_t>(k) % kPalette.size()];
  return {c[0], c[1], c[2]};
}

VertexColours region_colours(const Eigen::Ref<const Eigen::MatrixXd>& alpha,
                             const VertexColours& colours) {
  return alpha.cast<float>() * colours;
}

VertexColours surface_colours(const Topology& topology, const Surfaces& surfaces,
                              const Positions& positions, Axis front) {
  const auto paint = [](const LinearRgb& albedo) {
    return Eigen::RowVector3f(to_srgb(albedo).matrix().transpose());
  };
  VertexColours colours = paint(albedo_of(SurfaceKind::kSkin)).replicate(positions.rows(), 1);
  const std::vector<SurfaceKind>& kinds = surfaces.kinds;
  if (kinds.empty()) return colours;
  const Eigen::Vector3f gaze = unit_vector(front).cast<float>();
  const std::vector<float> points(positions.data(), positions.data() + positions.size());
  const Eyeballs eyeballs = find_eyeballs(topology, kinds);
  const std::vector<EyeballSphere> eyes = eyeball_spheres(eyeballs, points, gaze);
  for (Eigen::Index f = 0; f < topology.face_count(); ++f) {
    const SurfaceKind kind = kinds[static_cast<std::size_t>(f)];
    if (is_painted(surfaces, f)) {
      const Eigen::RowVector3f paint_of_face =
          surfaces.polygon_colours[static_cast<std::size_t>(f)]->matrix().transpose();
      for (const std::uint32_t vertex : topology.face(f)) colours.row(vertex) = paint_of_face;
      continue;
    }
    if (kind == SurfaceKind::kSkin || kind == SurfaceKind::kHidden) continue;
    for (const std::uint32_t vertex : topology.face(f)) {
      const LinearRgb albedo = kind == SurfaceKind::kEye
                                   ? eye_albedo(eyes[eyeballs.eyeball_of_vertex[vertex]], gaze,
                                                positions.row(vertex).cast<float>().transpose())
                                   : albedo_of(kind);
      colours.row(vertex) = paint(albedo);
    }
  }
  return colours;
}

std::optional<EyeCoordinates> eye_coordinates(const Topology& topology, const Surfaces& surfaces,
                                              const Positions& positions, Axis front) {
  const Eyeballs eyeballs = find_eyeballs(topology, surfaces.kinds);
  if (eyeballs.count == 0) return std::nullopt;
  const Eigen::Vector3f gaze = unit_vector(front).cast<float>();
  const auto [across, along] = tangent_basis(gaze);
  const std::vector<EyeballSphere> eyes =
      eyeball_spheres(eyeballs, {positions.data(), positions.data() + positions.size()}, gaze);
  EyeCoordinates coordinates(positions.rows(), 3);
  coordinates.rowwise() = Eigen::RowVector3f(0, 0, kNoEyeballCoordinate);
  bool any = false;
  for (Eigen::Index f = 0; f < topology.face_count(); ++f) {
    const bool eye = surfaces.kinds[static_cast<std::size_t>(f)] == SurfaceKind::kEye;
    if (!eye || is_painted(surfaces, f)) continue;
    for (const std::uint32_t vertex : topology.face(f)) {
      const EyeballSphere& placed = eyes[eyeballs.eyeball_of_vertex[vertex]];
      if (placed.radius <= 0) continue;
      const Eigen::Vector3f from =
          (positions.row(vertex).cast<float>().transpose() - placed.centre) / placed.radius;
      coordinates.row(vertex) << from.dot(across), from.dot(along), from.dot(gaze);
      any = true;
    }
  }
  if (!any) return std::nullopt;
  return coordinates;
}

VertexColours mask_colours(const Eigen::Ref<const Eigen::VectorXd>& mask,
                           const Eigen::Vector3f& colour) {
  const Eigen::RowVector3f clay(0.80F, 0.78F, 0.76F);
  VertexColours colours(mask.size(), 3);
  for (Eigen::Index i = 0; i < mask.size(); ++i) {
    const float share = static_cast<float>(std::clamp(mask[i], 0.0, 1.0));
    colours.row(i) = (1 - share) * clay + share * colour.transpose();
  }
  return colours;
}

}  // namespace crowdface
