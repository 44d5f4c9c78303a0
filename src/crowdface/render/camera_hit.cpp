// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/camera_hit.h"

#include <algorithm>
#include <cstdint>

#include <Eigen/Geometry>

namespace crowdface {
namespace {

using Vector = Eigen::Vector3f;

/// The index of the layer's texture on a quad, or kNone.
std::uint32_t texture_of(const HeadScene& scene, const TextureLayer& layer,
                         std::uint32_t primitive) {
  if (scene.textured_quads.empty() || layer.texture_of_polygon.empty()) return TextureLayer::kNone;
  const TexturedQuad& quad = scene.textured_quads[primitive];
  return quad.face == TextureLayer::kNone ? TextureLayer::kNone
                                          : layer.texture_of_polygon[quad.face];
}

/// The index of the colour texture on a quad, or kNone.
std::uint32_t texture_of(const HeadScene& scene, std::uint32_t primitive) {
  return scene.texture_set == nullptr ? TextureLayer::kNone
                                      : texture_of(scene, *scene.texture_set, primitive);
}

Eigen::Vector2f uv_at(const HeadScene& scene, std::uint32_t primitive,
                      const Eigen::Vector4f& weights) {
  const TexturedQuad& quad = scene.textured_quads[primitive];
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  for (int c = 0; c < 4; ++c) uv += weights[c] * quad.uvs[static_cast<std::size_t>(c)];
  return uv;
}

LinearRgb own_albedo(const HeadScene& scene, std::uint32_t primitive,
                     const Eigen::Vector4f& weights, const Vector& point) {
  const std::uint32_t texture = texture_of(scene, primitive);
  if (texture != TextureSet::kNone)
    return colour_at(*scene.texture_set->textures[texture], uv_at(scene, primitive, weights));
  if (!scene.quad_colours.empty() && scene.quad_colours[primitive])
    return *scene.quad_colours[primitive];
  const SurfaceKind kind = scene.kinds[primitive];
  if (kind != SurfaceKind::kEye) return albedo_of(kind);
  const std::uint32_t eye = scene.eyeballs.eyeball_of_vertex[scene.quads[primitive][0]];
  return eye_albedo(scene.eyes[eye], scene.gaze, point);
}

/// Tilts or flips a unit normal so that it faces the viewer. Interpolated normals may face away
/// although the face is visible, for example at the edge of a coarse ear.
Vector towards(const Vector& viewer, const Vector& normal) {
  const float away = normal.dot(viewer);
  return away < 0 ? Vector((normal - away * viewer).normalized()) : normal;
}

/// Tilts a unit normal by slopes along the texture axes (normal mapping).
Vector tilted_normal(const HeadScene& scene, std::uint32_t primitive, const Vector& normal,
                     const LinearRgb& slopes) {
  const Quad& quad = scene.quads[primitive];
  const TexturedQuad& textured = scene.textured_quads[primitive];
  // Derive the texture axes from the triangle at the first corner, and use them for the whole quad.
  const std::size_t last = quad[2] == quad[3] ? 2 : 3;
  const Vector origin = scene.point(quad[0]);
  const Vector one = scene.point(quad[1]) - origin;
  const Vector other = scene.point(quad[last]) - origin;
  const Eigen::Vector2f uv_one = textured.uvs[1] - textured.uvs[0];
  const Eigen::Vector2f uv_other = textured.uvs[last] - textured.uvs[0];
  const float area = uv_one.x() * uv_other.y() - uv_other.x() * uv_one.y();
  if (area == 0) return normal;
  const float sign = area > 0 ? 1.0F : -1.0F;
  const auto along = [&](const Vector& axis) -> Vector {
    const Vector flat = axis - axis.dot(normal) * normal;
    const float length = flat.norm();
    return length > 0 ? Vector(sign / length * flat) : Vector(Vector::Zero());
  };
  return (normal + slopes[0] * along(uv_other.y() * one - uv_one.y() * other) +
          slopes[1] * along(uv_one.x() * other - uv_other.x() * one))
      .normalized();
}

/// Applies the normal and roughness maps of the texture set.
void apply_surface_maps(const HeadScene& scene, std::uint32_t primitive,
                        const Eigen::Vector4f& weights, Vector& normal, ShadePoint& surface) {
  if (scene.texture_set == nullptr || surface.is_back) return;
  const TextureLayer& slopes = scene.texture_set->slopes;
  const TextureLayer& roughness = scene.texture_set->roughness;
  if (const auto at = texture_of(scene, slopes, primitive); at != TextureLayer::kNone) {
    normal = tilted_normal(scene, primitive, normal,
                           colour_at(*slopes.textures[at], uv_at(scene, primitive, weights)));
  }
  if (const auto at = texture_of(scene, roughness, primitive); at != TextureLayer::kNone) {
    surface.roughness = value_at(*roughness.textures[at], uv_at(scene, primitive, weights));
  }
}

}  // namespace

CameraHit camera_hit(const HeadScene& scene, const RayHit& hit, const Vector& direction) {
  const Quad& quad = scene.quads[hit.primitive];
  const Eigen::Vector4f weights = bilinear_weights(quad, hit.u, hit.v);
  CameraHit result;
  result.point = scene.viewer_position + hit.distance * direction;
  result.surface.kind = scene.kinds[hit.primitive];
  Vector normal = Vector::Zero();
  Vector colour = Vector::Zero();
  for (int c = 0; c < 4; ++c) {
    const std::uint32_t vertex = quad[static_cast<std::size_t>(c)];
    normal += weights[c] * scene.normals[vertex];
    if (scene.colours != nullptr) colour += weights[c] * scene.colours->row(vertex).transpose();
  }
  result.surface.albedo = scene.colours != nullptr
                              ? from_srgb(colour.array())
                              : own_albedo(scene, hit.primitive, weights, result.point);
  const std::uint32_t texture = texture_of(scene, hit.primitive);
  if (texture != TextureSet::kNone && result.surface.kind == SurfaceKind::kSkin)
    result.skin_lightness = scene.skin_lightness[texture];
  const Vector geometric = scene.winding_sign * hit.normal;
  result.surface.is_back = geometric.dot(direction) > 0;
  const float side = result.surface.is_back ? -1.0F : 1.0F;
  result.surface.to_viewer = -direction.normalized();
  normal.normalize();
  apply_surface_maps(scene, hit.primitive, weights, normal, result.surface);
  result.surface.normal = towards(result.surface.to_viewer, side * normal);
  result.can_receive_key_light = can_receive_key_light(result.surface.normal, result.surface.kind);
  // Start shadow rays on the smooth surface that the vertex normals imply. This surface lies above
  // the facets, so that facets do not show at grazing light (Hanika 2021, "Hacking the shadow
  // terminator"). At sharp edges a vertex normal may point below the facet. Such a normal would
  // move the start of the rays below the facet, so vertices with such normals are skipped.
  Vector lift = Vector::Zero();
  for (int c = 0; c < 4; ++c) {
    const std::uint32_t vertex = quad[static_cast<std::size_t>(c)];
    const Vector n = side * scene.normals[vertex];
    if (n.dot(side * geometric) <= 0) continue;
    lift -= weights[c] * std::min(0.0F, (result.point - scene.point(vertex)).dot(n)) * n;
  }
  result.ray_origin = result.point + lift + scene.ray_origin_offset * side * geometric.normalized();
  return result;
}

CameraHit attachment_hit(const HeadScene& scene, const RayHit& hit, const Vector& direction) {
  const AttachmentScene::HitSurface place = scene.attachments->surface_at(hit);
  CameraHit result;
  result.point = scene.viewer_position + hit.distance * direction;
  result.surface.kind = SurfaceKind::kAttachment;
  result.surface.albedo = place.colour;
  const Vector geometric = (hit.normal.dot(direction) > 0 ? -1.0F : 1.0F) * hit.normal.normalized();
  const Vector normal = (place.normal.dot(geometric) < 0 ? -1.0F : 1.0F) * place.normal;
  result.surface.is_back = false;
  result.surface.to_viewer = -direction.normalized();
  result.surface.normal =
      towards(result.surface.to_viewer, normal.norm() > 0 ? normal.normalized() : geometric);
  result.can_receive_key_light = can_receive_key_light(result.surface.normal, result.surface.kind);
  result.ray_origin = result.point + kRayClearance * geometric;
  return result;
}

void prefetch_hits(const HeadScene& scene, std::span<const std::optional<RayHit>> hits,
                   std::size_t current) {
  constexpr std::size_t kQuads = 24, kCorners = 12;
  if (current + kQuads < hits.size() && hits[current + kQuads]) {
    const std::uint32_t primitive = hits[current + kQuads]->primitive;
    __builtin_prefetch(&scene.quads[primitive]);
    __builtin_prefetch(&scene.kinds[primitive]);
  }
  if (current + kCorners < hits.size() && hits[current + kCorners]) {
    for (const std::uint32_t vertex : scene.quads[hits[current + kCorners]->primitive]) {
      __builtin_prefetch(&scene.normals[vertex]);
      __builtin_prefetch(scene.points.data() + std::size_t{3} * vertex);
    }
  }
}

}  // namespace crowdface
