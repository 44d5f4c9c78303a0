// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "crowdface/render/attachment_mesh.h"
#include "crowdface/render/camera.h"
#include "crowdface/render/ray_scene.h"

namespace crowdface {

/// All attachments of a face, in camera space, for ray tracing.
class AttachmentScene {
 public:
  /// \param attachments  at least one; their surfaces must outlive this object.
  /// \param size_px      side of the image, in pixels.
  AttachmentScene(const RayDevice& device, std::span<const AttachmentMesh> attachments,
                  const Camera& camera, int size_px);
  AttachmentScene(const AttachmentScene&) = delete;
  AttachmentScene& operator=(const AttachmentScene&) = delete;

  /// The quads of all attachments.
  const RayScene& scene() const { return *scene_; }
  /// Whether an attachment may be in front of some point of a pixel.
  bool may_cover(int x, int y) const {
    return may_cover_[static_cast<std::size_t>(y * size_px_ + x)];
  }

  /// The normal and the colour of an attachment at a hit.
  struct HitSurface {
    Eigen::Vector3f normal;  ///< interpolated, not normalised; may point away from the camera
    LinearRgb colour;        ///< linear, with the attachment's tint
  };
  /// Interpolates normal and colour at a hit of `scene()`.
  HitSurface surface_at(const RayHit& hit) const;

 private:
  /// One attachment in the scene.
  struct Part {
    const AttachmentSurface* surface;  ///< mesh and materials of the attachment
    std::uint32_t first_quad;          ///< index of the attachment's first quad in `quads_`
    LinearRgb tint;  ///< tint of the attachment: a factor for each channel of its colours
  };
  /// Returns the attachment to which a quad of the scene belongs.
  const Part& part_of(std::uint32_t quad) const;
  /// Sets `may_cover_` in the pixels of the image that the bounding box of any quad in `quads_`
  /// covers.
  /// \param points    3 coordinates per vertex of the quads, in camera space
  /// \param distance  distance from the viewer to the image, in the unit of camera space
  void mark_pixels(const std::vector<float>& points, float distance);

  int size_px_;                  ///< side of the image, in pixels
  std::vector<bool> may_cover_;  ///< for each pixel: the result of may_cover
  std::vector<Part> parts_;      ///< the attachments of the face
  std::vector<Quad> quads_;      ///< the quads of all attachments, one attachment after another
  /// for each quad: the level of the opacity's mip map, see AttachmentSurface::opacity
  std::vector<std::uint8_t> mip_levels_;
  std::vector<Eigen::Vector3f> normals_;  ///< vertex normals of all attachments
  std::unique_ptr<const RayScene> scene_;
};

}  // namespace crowdface
