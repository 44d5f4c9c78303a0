// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/texture/crowd_textures.h"

namespace crowdface {

/// The numbers of heads' maps as far as vertices can hold them. Taken on the mesh and not in the pictures, so that
/// no value knows of the texture's seams.
struct SurfaceStatistics {
  using Colours = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

  std::vector<Colours>
      coarse;  ///< #heads, each #V by 3: numbers without detail, smoothed over the mesh
  /// How the detail of two heads goes together around a vertex: the mean product of what their numbers
  /// differ from `coarse` by, summed over the channels.
  float covariance(std::size_t vertex, std::size_t a, std::size_t b) const {
    return covariances[vertex * pairs + pair(a, b)];
  }
  std::size_t pair(std::size_t a, std::size_t b) const {
    return a < b ? pair(b, a) : a * (a + 1) / 2 + b;
  }

  std::size_t pairs = 0;
  std::vector<float> covariances;  ///< #V by pairs
};

/// How many iterations of the lazy operator take detail away, and over how many its strength is averaged.
struct StatisticsScale {
  std::uint64_t detail = 4;
  std::uint64_t strength = 16;
};

/// \param filter  of the mesh, whatever its kind. \param texels  of each picture. \param maps  what heads have there.
SurfaceStatistics surface_statistics(const ChebyshevFilter& filter,
                                     const std::vector<SurfaceTexels>& texels, const HeadMaps& maps,
                                     const StatisticsScale& scale);

}  // namespace crowdface
