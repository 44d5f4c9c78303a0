// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/attachment_mesh.h"

#include <cmath>
#include <span>
#include <utility>

#include "crowdface/core/require.h"

namespace crowdface {

AttachmentSurface::AttachmentSurface(const Topology& topology, const TextureCoordinates& uvs,
                                     std::vector<AttachmentMaterial> materials,
                                     const std::vector<std::uint32_t>& of_face)
    : topology_(topology), fans_(topology), materials_(std::move(materials)) {
  require(!materials_.empty() && static_cast<Index>(of_face.size()) == topology.face_count(),
          "surface of an attachment: expected materials, and one index for each of ",
          topology.face_count(), " polygons; found ", materials_.size(), " materials and ",
          of_face.size(), " indices");
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    const auto uv_of_corner = [&](std::uint32_t corner) -> Eigen::Vector2f {
      const std::uint32_t row =
          topology.corner_uvs.empty() || uvs.rows() == 0 ? kNoIndex : topology.corner_uvs[corner];
      if (row == kNoIndex) return {0, 0};
      return uvs.row(row).transpose().cast<float>();
    };
    const auto add = [&](std::array<std::uint32_t, 4> corners) {
      Quad quad;
      std::array<Eigen::Vector2f, 4> corner_uvs;
      for (std::size_t c = 0; c < 4; ++c) {
        quad[c] = topology.corner_vertices[corners[c]];
        corner_uvs[c] = uv_of_corner(corners[c]);
      }
      quads_.push_back(quad);
      uvs_.push_back(corner_uvs);
      material_of_quad_.push_back(of_face[static_cast<std::size_t>(f)]);
    };
    if (end - begin == 4) {
      add({begin, begin + 1, begin + 2, begin + 3});
      continue;
    }
    for (std::uint32_t c = begin + 1; c + 1 < end; ++c) add({begin, c, c + 1, c + 1});
  }
}

Eigen::Vector2f AttachmentSurface::uv_at(std::uint32_t quad, const Eigen::Vector4f& weights) const {
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  for (int c = 0; c < 4; ++c) uv += weights[c] * uvs_[quad][static_cast<std::size_t>(c)];
  return uv;
}

LinearRgb AttachmentSurface::colour(std::uint32_t quad, const Eigen::Vector4f& weights) const {
  const AttachmentMaterial& material = materials_[material_of_quad_[quad]];
  return material.texture ? colour_at(*material.texture, uv_at(quad, weights)) : material.colour;
}

float AttachmentSurface::opacity(std::uint32_t quad, const Eigen::Vector4f& weights,
                                 std::uint8_t level) const {
  const AttachmentMaterial& material = materials_[material_of_quad_[quad]];
  if (!material.opacity) return material.opacity_factor;
  return material.opacity_factor * value_at(material.opacity->levels[level], uv_at(quad, weights));
}

std::uint8_t AttachmentSurface::mip_level(std::uint32_t quad, float pixel_count) const {
  const AttachmentMaterial& material = materials_[material_of_quad_[quad]];
  if (!material.opacity) return 0;
  const std::vector<Texture>& levels = material.opacity->levels;
  const std::array<Eigen::Vector2f, 4>& uvs = uvs_[quad];
  const Eigen::Vector2f one = uvs[2] - uvs[0], other = uvs[3] - uvs[1];  // diagonals
  const float texel_count = std::abs(one.x() * other.y() - one.y() * other.x()) / 2 *
                            static_cast<float>(levels[0].width) *
                            static_cast<float>(levels[0].height);
  // The level is log₄(texel_count / pixel_count), rounded to the nearest integer. Do not use
  // std::log2, because the last bit of its result differs between versions of the C library.
  std::uint8_t level = 0;
  for (float ratio = texel_count / pixel_count; ratio >= 2 && level + 1U < levels.size();
       ratio /= 4) {
    ++level;
  }
  return level;
}

}  // namespace crowdface
