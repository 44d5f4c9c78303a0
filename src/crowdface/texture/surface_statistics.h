// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/texture/crowd_textures.h"

namespace crowdface {

/// Low-frequency statistics of the heads' texture maps, per vertex. The statistics are smoothed on
/// the mesh and not in texture space, so that texture seams have no effect.
struct SurfaceStatistics {
  /// Three channels per vertex: #V by 3.
  using Colours = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

  /// for each head, #V by 3: values of the head's maps, smoothed over the mesh
  std::vector<Colours> coarse_values;
  /// The covariance of the details of heads a and b around a vertex. The detail of a head at a
  /// point is the value of the head's map minus the head's `coarse_values`. The function returns
  /// the mean, over the points around the vertex, of the dot product of both details (the sum over
  /// the channels).
  float covariance(std::size_t vertex, std::size_t a, std::size_t b) const {
    return covariances[vertex * pair_count + pair_index(a, b)];
  }
  /// Index of an unordered pair of heads among all pairs: a packed lower triangular matrix.
  std::size_t pair_index(std::size_t a, std::size_t b) const {
    return a < b ? pair_index(b, a) : a * (a + 1) / 2 + b;
  }

  std::size_t pair_count = 0;  ///< number of unordered pairs of heads, including the pairs (a, a)
  std::vector<float> covariances;  ///< the results of `covariance`, #V by #pairs
};

/// Smoothing scales of the statistics, as numbers of iterations with the operator
/// OperatorKind::kLazy.
struct StatisticsScale {
  /// Number of iterations that remove the detail from the maps; the results are `coarse_values`.
  std::uint64_t detail_iterations = 4;
  /// Number of iterations that smooth the covariances.
  std::uint64_t covariance_iterations = 16;
};

/// Computes the statistics of the heads' maps.
/// \param filter  a smoothing filter of the mesh, with the umbrella or the lazy operator.
/// \param texels  #pictures: the rasterized surface in each picture.
/// \param maps    #pictures by #heads.
SurfaceStatistics surface_statistics(const ChebyshevFilter& filter,
                                     const std::vector<SurfaceTexels>& texels, const HeadMaps& maps,
                                     const StatisticsScale& scale);

}  // namespace crowdface
