// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/render/camera.h"
#include "crowdface/render/rgb8_image.h"
#include "crowdface/render/surface_kind.h"
#include "crowdface/render/texture.h"
#include "crowdface/render/vertex_colours.h"
#include "crowdface/render/worn_mesh.h"

namespace crowdface {

struct RenderOptions {
  int size_px = 256;         ///< side of the square image
  int samples_per_side = 3;  ///< antialiasing: this squared samples a pixel where the picture
                             ///< changes, at fixed places; four where it does not
  int key_rays = 3;          ///< a pixel towards the key light; pixels share what theirs find
  int sky_rays = 2;          ///< the same towards the sky, where nothing has sharp edges
  bool occlusion = true;     ///< whether the sky's light is kept out of hollows
  Axis front = {2, 1};       ///< where the eyes look: irises are painted there
};

/// Renders faces of one topology as clay in a portrait studio. Prepared once, then any number of
/// faces, from any thread; the same pixels each time on one machine, whatever the thread count.
/// Triangles and quads as they are, larger polygons as fans around their first corner, faces with
/// fewer than three corners not at all.
class FaceRenderer {
 public:
  /// \param typical  #V by 3, how faces look about, and how they are wound. The ray tracer's tree is then built once for it
  ///                 and fitted to each face, which saves most of a large mesh's time; without it
  ///                 the tree is built for every face anew.
  /// \throws BrokenPrecondition if sizes or options make no sense.
  explicit FaceRenderer(const Topology& topology, const RenderOptions& options = {},
                        const Surfaces& surfaces = {}, const Positions* typical = nullptr);
  ~FaceRenderer();

  /// \param positions  #V by 3, in the camera's unit. If the whole mesh is wound inside out (as a
  ///                   mirrored one is), it is turned.
  /// \param colours    #V by 3 instead of the surfaces' own, or nullptr.
  /// \param coat       textures for the faces they cover, or nullptr.
  /// \param worn       what is drawn beside the face.
  /// \throws BrokenPrecondition if a size does not fit, InvalidInput if a position is not finite.
  Rgb8Image render(const Positions& positions, const Camera& camera,
                   const VertexColours* colours = nullptr, const TextureCoat* coat = nullptr,
                   std::span<const WornMesh> worn = {}) const;

 private:
  struct Prepared;
  std::unique_ptr<Prepared> prepared_;
};

}  // namespace crowdface
