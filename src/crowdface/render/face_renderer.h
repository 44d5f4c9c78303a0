// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/render/attachment_mesh.h"
#include "crowdface/render/camera.h"
#include "crowdface/render/rgb8_image.h"
#include "crowdface/render/surface_kind.h"
#include "crowdface/render/texture.h"
#include "crowdface/render/vertex_colours.h"

namespace crowdface {

/// Options of FaceRenderer.
struct RenderOptions {
  int size_px = 256;  ///< side of the square image, in pixels
  /// Antialiasing: pixels at edges get samples_per_side² samples at fixed positions; other pixels
  /// get fewer samples.
  int samples_per_side = 3;
  /// Rays per pixel towards the key light. The results of the rays are averaged over neighbouring
  /// pixels.
  int key_light_rays = 3;
  /// Rays per pixel towards the sky. The sky needs fewer rays than the key light, because the sky
  /// casts no sharp shadows.
  int sky_rays = 2;
  bool ambient_occlusion = true;  ///< whether surfaces block light from the sky
  Axis front = {2, 1};  ///< direction in which the eyes look, for painted irises; default +Z
};

/// Renders human faces of one topology in portrait light. Faces without colours and textures look
/// like clay. Construct once, then render any number of faces from any thread. On one machine the
/// pixels are reproducible and do not depend on the thread count. Polygons with more than four
/// corners are drawn as fans around their first corner; polygons with fewer than three corners are
/// skipped.
class FaceRenderer {
 public:
  /// \param average_face  positions of an average face, #V by 3, or null. If given, the ray tracer
  ///                      builds its tree once for this face and refits the tree to each rendered
  ///                      face, which saves most of the time on large meshes. All faces must then
  ///                      have the same winding as this face. If null, the tree is rebuilt for
  ///                      every face.
  /// \throws BrokenPrecondition if sizes or options are invalid.
  explicit FaceRenderer(const Topology& topology, const RenderOptions& options = {},
                        const Surfaces& surfaces = {}, const Positions* average_face = nullptr);
  ~FaceRenderer();

  /// Renders a face.
  /// \param positions  #V by 3, in the unit of the camera. If the constructor got no average face,
  ///                   the normals of a mesh that is inside out (such as a mirrored mesh) are
  ///                   flipped.
  /// \param colours    #V by 3, override all other colours and textures; or nullptr.
  /// \param texture_set  textures for all or some of the polygons; or nullptr.
  /// \param attachments  attachments rendered with the face.
  /// \throws BrokenPrecondition if a size does not match; InvalidInput if a position is not finite.
  Rgb8Image render(const Positions& positions, const Camera& camera,
                   const VertexColours* colours = nullptr, const TextureSet* texture_set = nullptr,
                   std::span<const AttachmentMesh> attachments = {}) const;

 private:
  struct PreparedMesh;  // all data that do not depend on the rendered face
  std::unique_ptr<PreparedMesh> prepared_;
};

}  // namespace crowdface
