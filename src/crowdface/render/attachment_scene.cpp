// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/attachment_scene.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

#include "crowdface/core/require.h"
#include "crowdface/render/camera_space.h"

namespace crowdface {
namespace {

/// Area of a quad. \param points  3 coordinates per vertex.
float area_of(const Quad& quad, const std::vector<float>& points) {
  const auto point = [&](int corner) {
    return Eigen::Map<const Eigen::Vector3f>(
        points.data() + std::size_t{3} * quad[static_cast<std::size_t>(corner)]);
  };
  return (point(2) - point(0)).cross(point(3) - point(1)).norm() / 2;
}

}  // namespace

AttachmentScene::AttachmentScene(const RayDevice& device,
                                 std::span<const AttachmentMesh> attachments, const Camera& camera,
                                 int size_px)
    : size_px_(size_px),
      may_cover_(static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px)) {
  std::vector<float> points;
  for (const AttachmentMesh& mesh : attachments) {
    const AttachmentSurface& surface = *mesh.surface;
    require(mesh.positions->rows() == surface.topology().vertex_count, "render: an attachment has ",
            mesh.positions->rows(), " positions, expected ", surface.topology().vertex_count,
            ", one per vertex");
    const auto first = static_cast<std::uint32_t>(points.size() / 3);
    parts_.push_back({&surface, static_cast<std::uint32_t>(quads_.size()), mesh.tint});
    const std::vector<float> own = to_camera_space(*mesh.positions, camera);
    const auto normals = camera_normals(surface.topology(), surface.fans(), own, 1);
    const float pixel_side = 2.0F / static_cast<float>(size_px);  // the image spans −1 … 1
    for (std::size_t q = 0; q < surface.quads().size(); ++q) {
      const float pixel_count = area_of(surface.quads()[q], own) / (pixel_side * pixel_side);
      mip_levels_.push_back(surface.mip_level(static_cast<std::uint32_t>(q), pixel_count));
    }
    points.insert(points.end(), own.begin(), own.end());
    normals_.insert(normals_.end(), normals.begin(), normals.end());
    for (Quad quad : surface.quads()) {
      for (std::uint32_t& vertex : quad) vertex += first;
      quads_.push_back(quad);
    }
  }
  mark_pixels(points, static_cast<float>(1 / camera.tan_half_fov));
  scene_ = std::make_unique<const RayScene>(
      device, std::move(points), quads_, RayScene::Tree::kStatic,
      [this](std::uint32_t quad, float u, float v) {
        const Part& part = part_of(quad);
        return part.surface->opacity(quad - part.first_quad, bilinear_weights(quads_[quad], u, v),
                                     mip_levels_[quad]);
      });
}

void AttachmentScene::mark_pixels(const std::vector<float>& points, float distance) {
  using Box = Eigen::AlignedBox2f;
  const float half_side = 0.5F * static_cast<float>(size_px_);
  const Box image(Eigen::Vector2f::Zero(), Eigen::Vector2f::Constant(2 * half_side - 1));
  for (const Quad& quad : quads_) {
    Box box;
    for (const std::uint32_t vertex : quad) {
      const float* p = points.data() + std::size_t{3} * vertex;
      const float depth = distance - p[2];
      if (depth <= 0) {  // a vertex behind the viewer: the quad may be anywhere on the image
        box = image;
        break;
      }
      box.extend(half_side *
                 Eigen::Vector2f(1 + p[0] * distance / depth, 1 - p[1] * distance / depth));
    }
    const Box inside = box.intersection(image);
    if (box.max().minCoeff() < 0 || inside.isEmpty()) continue;
    const Eigen::Vector2i low = inside.min().cast<int>(), high = inside.max().cast<int>();
    for (int y = low.y(); y <= high.y(); ++y) {
      const auto row = may_cover_.begin() + std::ptrdiff_t{y} * size_px_;
      std::fill(row + low.x(), row + high.x() + 1, true);
    }
  }
}

const AttachmentScene::Part& AttachmentScene::part_of(std::uint32_t quad) const {
  const auto after =
      std::upper_bound(parts_.begin(), parts_.end(), quad,
                       [](std::uint32_t q, const Part& part) { return q < part.first_quad; });
  return *(after - 1);
}

AttachmentScene::HitSurface AttachmentScene::surface_at(const RayHit& hit) const {
  const Quad& quad = quads_[hit.primitive];
  const Eigen::Vector4f shares = bilinear_weights(quad, hit.u, hit.v);
  const Part& part = part_of(hit.primitive);
  HitSurface surface{Eigen::Vector3f::Zero(),
                     part.surface->colour(hit.primitive - part.first_quad, shares) * part.tint};
  for (int c = 0; c < 4; ++c) {
    surface.normal += shares[c] * normals_[quad[static_cast<std::size_t>(c)]];
  }
  return surface;
}

}  // namespace crowdface
