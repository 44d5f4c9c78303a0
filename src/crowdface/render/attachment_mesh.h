// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "crowdface/mesh/normals.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/render/ray_scene.h"
#include "crowdface/render/texture.h"

namespace crowdface {

/// Material of an attachment.
struct AttachmentMaterial {
  LinearRgb colour = LinearRgb::Constant(0.5F);  ///< linear colour, used if `texture` is null
  std::shared_ptr<const Texture> texture = {};   ///< texture with the colours, or null
  /// image with the opacity in the first channel; null: the material is opaque
  std::shared_ptr<const MipMap> opacity = {};
  float opacity_factor = 1;  ///< factor on the opacity, 0 … 1
};

/// The mesh of an attachment, such as hair or glasses, that is rendered with a face. Polygons look
/// the same from both sides, and may be transparent.
class AttachmentSurface {
 public:
  /// \param uvs        #T by 2, may be empty.
  /// \param materials  at least one.
  /// \param material_of_polygon  for each polygon, an index into `materials`.
  AttachmentSurface(const Topology& topology, const TextureCoordinates& uvs,
                    std::vector<AttachmentMaterial> materials,
                    const std::vector<std::uint32_t>& material_of_polygon);

  const Topology& topology() const { return topology_; }
  /// The polygons around each vertex, for computing normals.
  const NormalFans& fans() const { return fans_; }
  /// The polygons, split into quads and triangles. A triangle is a Quad that repeats its last
  /// vertex.
  const std::vector<Quad>& quads() const { return quads_; }
  /// The materials of the attachment; each quad has one of them.
  const std::vector<AttachmentMaterial>& materials() const { return materials_; }

  /// Linear colour at a point of a quad. \param weights  interpolation weights from
  /// bilinear_weights.
  LinearRgb colour(std::uint32_t quad, const Eigen::Vector4f& weights) const;
  /// Opacity at a point of a quad. \param level  level of the opacity's mip map, from mip_level().
  float opacity(std::uint32_t quad, const Eigen::Vector4f& weights, std::uint8_t level) const;
  /// Returns a level of the opacity's mip map: the level whose texels are about as large as a
  /// pixel.
  /// \param pixel_count  area of the quad, in pixels.
  std::uint8_t mip_level(std::uint32_t quad, float pixel_count) const;

 private:
  /// Texture coordinates at a point of a quad.
  Eigen::Vector2f uv_at(std::uint32_t quad, const Eigen::Vector4f& weights) const;

  Topology topology_;
  NormalFans fans_;
  std::vector<AttachmentMaterial> materials_;
  std::vector<Quad> quads_;
  std::vector<std::uint32_t> material_of_quad_;  ///< for each quad, an index into `materials_`
  /// #quads: texture coordinates of the four corners
  std::vector<std::array<Eigen::Vector2f, 4>> uvs_;
};

/// An attachment placed on a face.
struct AttachmentMesh {
  const AttachmentSurface* surface;  ///< topology and materials of the attachment
  const Positions* positions;        ///< vertex positions on the face, #V by 3
  /// tint of the attachment: a factor for each channel of its colours
  LinearRgb tint = LinearRgb::Constant(1);
};

/// Interpolation weights of a quad's four vertices at a point (u, v) of the quad.
inline Eigen::Vector4f bilinear_weights(const Quad& quad, float u, float v) {
  if (quad[2] == quad[3]) return {1 - u - v, u, v, 0};
  return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
}

}  // namespace crowdface
