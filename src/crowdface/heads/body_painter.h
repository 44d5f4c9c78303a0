// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "crowdface/heads/heads_on_body.h"
#include "crowdface/texture/crowd_textures.h"
#include "crowdface/texture/optical_density.h"
#include "crowdface/texture/surface_texels.h"

namespace crowdface {

/// Paints a texture of the body for each face, so that body and face have the same colours at the
/// ring of the neck. The painter adds a change to the body's optical densities. At each vertex of
/// the ring, the sum equals the face's optical density. Farther than `falloff_mm` from the ring,
/// the change is the mean change over the ring. In between, the change varies smoothly.
class BodyPainter {
 public:
  /// \param neck     must have a body and outlive this object.
  /// \param texture  path of an image in the body's texture coordinates. If the path is empty, the
  ///                 body has no colours of its own: it gets the face's colours at the ring of the
  ///                 neck, and new texture coordinates.
  BodyPainter(const HeadsOnBody& neck, double falloff_mm, const std::filesystem::path& texture);

  /// The body's polygons. Their corners refer to rows of uvs().
  const Topology& topology() const { return topology_; }
  /// Texture coordinates of the body in the image that `paint` returns, #T by 2.
  const TextureCoordinates& uvs() const { return uvs_; }

  /// Paints the body's texture for one face.
  /// \param ring_densities  optical densities of the face's skin at the vertices of the neck's
  ///                        ring, one row of 3 channels for each vertex
  BlendedPicture paint(const OpticalDensities& ring_densities) const;

 private:
  const HeadsOnBody& heads_on_body_;
  Topology topology_;                            ///< result of `topology()`
  TextureCoordinates uvs_;                       ///< result of `uvs()`
  std::shared_ptr<const TextureMap> map_;        ///< the body's own texture, or one white texel
  std::unique_ptr<const SurfaceTexels> texels_;  ///< for each texel: the triangle that covers it
  /// optical densities of the body's own colours at the vertices of the neck's ring, one row of 3
  /// channels for each vertex
  OpticalDensities body_optical_densities_;
  /// Spreads the difference between the face's and the body's colours from the neck's ring over the
  /// body, with the method that NeckBend uses for displacements. The change of the body's colours
  /// fades with the distance from the ring.
  NeckBend neck_bend_for_colours_;
};

}  // namespace crowdface
