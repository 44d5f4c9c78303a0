// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "crowdface/render/eyeballs.h"
#include "crowdface/render/ray_scene.h"
#include "crowdface/render/screen_quads.h"
#include "crowdface/render/shading.h"
#include "crowdface/render/surface_kind.h"
#include "crowdface/render/texture.h"
#include "crowdface/render/vertex_colours.h"
#include "crowdface/render/worn_stage.h"

namespace crowdface {

/// Where a primitive lies on its texture.
struct TexturedQuad {
  std::uint32_t face;  ///< of the topology, or TextureCoat::kNone
  std::array<Eigen::Vector2f, 4> uvs;
};

/// A head as the camera sees it: x right, y up, z towards the camera, target at the origin, half
/// the image's side as unit.
struct Stage {
  const std::vector<float>& points;             ///< x, y, z of each vertex
  const ScreenQuads& screen;                    ///< all quads
  const RayScene& occluders;                    ///< what keeps light out: all of it, or reduced
  float clearance;                              ///< rays to the lights start this far above it
  const std::vector<Eigen::Vector3f>& normals;  ///< #V, outwards
  float winding;                                ///< −1 where the faces' own normals look inwards
  const VertexColours* colours;                 ///< #V in place of all others, or nullptr
  const std::vector<Quad>& quads;
  const std::vector<SurfaceKind>& kinds;            ///< #quads
  const std::vector<std::optional<Light>>& paints;  ///< #quads, linear; or empty
  const std::vector<TexturedQuad>& uvs;             ///< #quads, or empty
  const TextureCoat* coat;                          ///< or nullptr
  std::vector<float> skin_lightness;                ///< of each of its pictures
  const Eyeballs& eyeballs;
  std::vector<PlacedEye> eyes;
  Eigen::Vector3f gaze;
  const WornStage* worn;  ///< or nullptr
  bool occlusion;         ///< whether the sky's light is kept out of hollows
  Eigen::Vector3f viewer;

  Eigen::Map<const Eigen::Vector3f> point(std::uint32_t vertex) const {
    return Eigen::Map<const Eigen::Vector3f>(points.data() + std::size_t{3} * vertex);
  }
};

/// Rays to the lights start this far above a surface that is its own occluder, in half the side of the image.
inline constexpr float kRayClearance = 2e-4F;

}  // namespace crowdface
