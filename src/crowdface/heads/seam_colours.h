// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "crowdface/heads/inputs.h"
#include "crowdface/texture/optical_density.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface {

/// The colours of the heads' skin in a band above the neck's ring, without detail. Faces blend
/// these colours like their textures or their vertex colours.
class SeamColours {
 public:
  /// \param inputs   must have a neck and outlive this object.
  /// \param blended  blends the faces' colour textures; null if faces have no colour textures of
  ///                 their own.
  SeamColours(const Inputs& inputs, const TextureBlender* blended);

  /// Whether the colours of at least one head's skin above the neck's ring are known.
  bool has_colours() const;
  /// Colours at the vertices of the neck's ring: optical densities (see `Density`), one row of 3
  /// channels for each vertex.
  /// \param weights  one per head; heads without colours are left out. If all weights are zero, all
  ///                 heads get equal weights
  OpticalDensities optical_densities_at_ring(const std::vector<double>& weights) const;
  /// Mean colour, in linear light, of the skin in the band above the neck's ring, blended from all
  /// heads with `weights`.
  Eigen::Array3d mean_colour(const std::vector<double>& weights) const;

 private:
  /// The weighted mean of the heads' optical densities at the first `rows` entries of `vertices_`,
  /// #rows by 3.
  OpticalDensities blend(const std::vector<double>& weights, Index rows) const;

  /// the vertices of the band: first the vertices of the neck ring, then all others
  std::vector<std::uint32_t> vertices_;
  Index ring_size_ = 0;  ///< number of vertices in the neck's ring
  /// area around each of the `vertices_`, as a fraction of the band's area
  std::vector<double> areas_;
  /// for each head, the optical densities of its colours at the `vertices_`, #vertices_ by 3; no
  /// rows if unknown
  std::vector<OpticalDensities> head_optical_densities_;
};

}  // namespace crowdface
