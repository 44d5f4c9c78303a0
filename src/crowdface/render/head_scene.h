// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "crowdface/render/attachment_scene.h"
#include "crowdface/render/eyeballs.h"
#include "crowdface/render/ray_scene.h"
#include "crowdface/render/screen_quads.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/surface_kind.h"
#include "crowdface/render/texture.h"
#include "crowdface/render/vertex_colours.h"

namespace crowdface {

/// Texture coordinates of a quad.
struct TexturedQuad {
  std::uint32_t face;  ///< index of the polygon in the topology, or TextureSet::kNone
  std::array<Eigen::Vector2f, 4> uvs;  ///< one per corner of the quad
};

/// A head in camera space (see camera_space.h), with all data for rendering it.
struct HeadScene {
  const std::vector<float>& points;  ///< x, y, z of each vertex
  const ScreenQuads& rasterizer;     ///< finds the hits of camera rays on all quads
  const RayScene& occluders;         ///< mesh that occludes light: the full or a reduced mesh
  /// distance by which the origins of shadow rays are moved off the surface, to avoid hits of the
  /// surface itself
  float ray_origin_offset;
  const std::vector<Eigen::Vector3f>& normals;  ///< #V unit normals, outward
  float winding_sign;                           ///< +1, or −1 if the winding is inside out
  /// vertex colours, which override all other colours; or nullptr
  const VertexColours* colours;
  const std::vector<Quad>& quads;         ///< polygons, split into quads
  const std::vector<SurfaceKind>& kinds;  ///< kind of each quad
  /// linear colour of each quad that has a colour of its own; or empty
  const std::vector<std::optional<LinearRgb>>& quad_colours;
  const std::vector<TexturedQuad>& textured_quads;  ///< texture coordinates of each quad; or empty
  const TextureSet* texture_set;                    ///< textures of the head, or nullptr
  std::vector<float> skin_lightness;   ///< skin_lightness() of each colour texture of `texture_set`
  const Eyeballs& eyeballs;            ///< which vertices form eyeballs
  std::vector<EyeballSphere> eyes;     ///< position and size of each eyeball
  Eigen::Vector3f gaze;                ///< direction in which the eyes look, a unit vector
  const AttachmentScene* attachments;  ///< attachments that are rendered with the head, or nullptr
  bool ambient_occlusion;              ///< whether surfaces block light from the sky
  Eigen::Vector3f viewer_position;     ///< position of the camera

  /// Position of a vertex.
  Eigen::Map<const Eigen::Vector3f> point(std::uint32_t vertex) const {
    return Eigen::Map<const Eigen::Vector3f>(points.data() + std::size_t{3} * vertex);
  }
};

/// Distance of ray origins from the surface, so that the surface does not block its own rays. In
/// camera space (half the side of the image is 1).
inline constexpr float kRayClearance = 2e-4F;

}  // namespace crowdface
