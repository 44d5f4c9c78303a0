// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "crowdface/texture/crowd_textures.h"
#include "crowdface/texture/row_kernels.h"

namespace crowdface {

/// The input of paint_picture for one texture image of one face: for each vertex in the image, a
/// base value per channel, and for each head a factor on the head's map. Both are interpolated
/// linearly within triangles.
struct VertexFactorsOfImage {
  std::size_t channels = 3;        ///< number of channels of the image
  std::vector<std::size_t> heads;  ///< heads whose maps contribute to the image, ascending
  /// for each vertex: a base value per channel, then a factor per head; see `resize`
  std::vector<float> values;
  /// Allocates `values`, and kRowSlack more floats that kernels may read. Call after setting
  /// `channels` and `heads`.
  void resize(std::size_t vertex_count) {
    values.resize(vertex_count * values_per_vertex() + kRowSlack);
  }
  /// Number of `values` of each vertex.
  std::size_t values_per_vertex() const { return channels + heads.size(); }
};

/// Computes a texture image of a face. The value of a texel that the mesh covers is the base value
/// plus Σ_h (factor of head h) · (stored value of head h's map). Texels beyond the gutter get the
/// mean of the covered texels.
/// \param coding  content of the image, and the range to which its values are clamped.
/// \param maps    one map per head, each with the size of the picture.
/// \param fields  the base values and the factors of the heads.
BlendedPicture paint_picture(const SurfaceTexels& texels, const MapCoding& coding,
                             const std::vector<std::shared_ptr<const TextureMap>>& maps,
                             const VertexFactorsOfImage& fields);

}  // namespace crowdface
