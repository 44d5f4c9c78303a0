// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/texture/crowd_textures.h"

namespace crowdface {

/// Low-frequency statistics of the heads' maps, stored per vertex. Computed on the mesh and not in
/// texture space, so that texture seams do not affect them.
struct SurfaceStatistics {
  using Colours = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

  std::vector<Colours>
      coarse;  ///< #heads, each #V by 3: the map's values without detail, smoothed over the mesh
  /// The covariance of the detail of heads a and b around a vertex: the mean product of the
  /// differences between map and `coarse`, summed over the channels.
  float covariance(std::size_t vertex, std::size_t a, std::size_t b) const {
    return covariances[vertex * pairs + pair(a, b)];
  }
  /// Index of a pair of heads, in any order, in the packed lower triangle.
  std::size_t pair(std::size_t a, std::size_t b) const {
    return a < b ? pair(b, a) : a * (a + 1) / 2 + b;
  }

  std::size_t pairs = 0;
  std::vector<float> covariances;  ///< #V by #pairs
};

/// Smoothing scales, in iterations of the lazy operator.
struct StatisticsScale {
  /// Iterations that smooth detail away in `coarse`.
  std::uint64_t detail = 4;
  /// Iterations that smooth the covariances.
  std::uint64_t strength = 16;
};

/// Computes the statistics.
/// \param filter  a filter of the mesh, of either operator kind.
/// \param texels  one for each picture.
/// \param maps    #pictures by #heads.
SurfaceStatistics surface_statistics(const ChebyshevFilter& filter,
                                     const std::vector<SurfaceTexels>& texels, const HeadMaps& maps,
                                     const StatisticsScale& scale);

}  // namespace crowdface
