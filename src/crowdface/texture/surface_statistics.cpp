// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/surface_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"
#include "crowdface/smooth/iterate.h"

namespace crowdface {
namespace {

using Colours = SurfaceStatistics::Colours;

/// More texels than this tell no more about means.
constexpr double kMostSamples = 1 << 21;
constexpr Index kBlock = 1024;

/// A texel, and where on the surface it lies.
struct Sample {
  std::uint32_t picture = 0;
  std::uint32_t texel = 0;  ///< row · width + column
  std::array<std::uint32_t, 3> vertices = {};
  std::array<float, 3> shares = {};
};

/// The numbers of a texel, 0 where the map has less than three.
Eigen::Array3f numbers_at(const TextureMap& map, std::uint32_t texel) {
  const auto channels = static_cast<std::size_t>(map.coding.channels);
  const std::span<const Density> stored = map.stored();
  Eigen::Array3f numbers = Eigen::Array3f::Zero();
  for (std::size_t c = 0; c < channels; ++c) {
    numbers[static_cast<Index>(c)] = map.number(stored[c * map.texels() + texel]);
  }
  return numbers;
}

/// Calls `put(vertex, sample)` for every step-th texel of every step-th row, at the vertex that it lies
/// nearest to, and for one texel at each vertex that has none of these.
template <class Put>
void for_each_sample(const std::vector<SurfaceTexels>& all, int step, std::size_t vertex_count,
                     const Put& put) {
  std::vector<bool> has_any(vertex_count);
  const auto visit = [&](std::uint32_t p, int y, int x, const SurfaceTexels::Span& span,
                         const auto& take) {
    const SurfaceTexels& texels = all[p];
    const SurfaceTexels::Triangle& triangle = texels.triangle(span.triangle);
    const auto share = [&](const std::array<float, 3>& of) {
      return of[0] + static_cast<float>(x) * of[1] + static_cast<float>(y) * of[2];
    };
    const float b = share(triangle.second), c = share(triangle.third);
    Sample sample{p,
                  static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(texels.width()) +
                      static_cast<std::uint32_t>(x),
                  {},
                  {1 - b - c, b, c}};
    for (std::size_t i = 0; i < 3; ++i) {
      sample.vertices[i] = texels.vertices()[triangle.corners[i]];
    }
    take(sample);
  };
  for (std::uint32_t p = 0; p < all.size(); ++p) {
    for (int y = 0; y < all[p].height(); y += step) {
      for (const SurfaceTexels::Span& span : all[p].row(y)) {
        for (int x = (span.begin + step - 1) / step * step; x < span.end; x += step) {
          visit(p, y, x, span, [&](const Sample& sample) {
            const auto nearest = static_cast<std::size_t>(std::ranges::max_element(sample.shares) -
                                                          sample.shares.begin());
            has_any[sample.vertices[nearest]] = true;
            put(sample.vertices[nearest], sample);
          });
        }
      }
    }
  }
  for (std::uint32_t p = 0; p < all.size(); ++p) {
    for (int y = 0; y < all[p].height(); ++y) {
      for (const SurfaceTexels::Span& span : all[p].row(y)) {
        visit(p, y, span.begin, span, [&](const Sample& sample) {
          for (const std::uint32_t vertex : sample.vertices) {
            if (has_any[vertex]) continue;
            has_any[vertex] = true;
            put(vertex, sample);
          }
        });
      }
    }
  }
}

Grouped<Sample> sample_surface(const std::vector<SurfaceTexels>& texels, std::size_t vertices) {
  double covered = 0;
  for (const SurfaceTexels& picture : texels) covered += static_cast<double>(picture.covered());
  const int step = std::max(1, static_cast<int>(std::ceil(std::sqrt(covered / kMostSamples))));
  return grouped<Sample>(vertices,
                         [&](const auto& put) { for_each_sample(texels, step, vertices, put); });
}

/// Smooths values that only some vertices have. \param values  #V by C, the last column 1 where there is
/// one and else a row of zeros; there it becomes 0 where none is near.
void smooth_known(const SmoothingOperator& smoothing, std::uint64_t level, Columns& values) {
  values = iterate(smoothing, values, level);
  for (Index v = 0; v < values.rows(); ++v) {
    const double known = values(v, values.cols() - 1);
    if (known > 0) values.row(v) /= known;
  }
}

Colours coarse_colours(const Grouped<Sample>& samples, const HeadMaps& maps, std::size_t head,
                       const SmoothingOperator& smoothing, std::uint64_t level) {
  const auto vertices = static_cast<Index>(samples.group_count());
  Columns sums = Columns::Zero(vertices, 4);
  parallel_for_each(vertices, kBlock, [&](Index v) {
    double count = 0;
    for (const Sample& sample : samples.of(v)) {
      const TextureMap* map = maps[sample.picture][head].get();
      if (map == nullptr) continue;
      sums.row(v).head(3) += numbers_at(*map, sample.texel).cast<double>().matrix().transpose();
      count += 1;
    }
    if (count == 0) return;
    sums.row(v) /= count;
    sums(v, 3) = 1;
  });
  smooth_known(smoothing, level, sums);
  return sums.leftCols(3).cast<float>();
}

/// The mean products of details, before they are smoothed; of vertices where a head has nothing, 0.
void multiply_details(const Grouped<Sample>& samples, const HeadMaps& maps,
                      SurfaceStatistics& statistics, std::vector<bool>& known) {
  const std::size_t heads = statistics.coarse.size();
  std::vector<std::uint8_t> is_known(known.size(), 0);
  parallel_blocks(static_cast<Index>(samples.group_count()), kBlock, [&](Index begin, Index end) {
    std::vector<Eigen::Array3f> detail(heads);
    std::vector<bool> has(heads);
    std::vector<double> sums(statistics.pairs), counts(statistics.pairs);
    for (Index v = begin; v < end; ++v) {
      std::ranges::fill(sums, 0.0);
      std::ranges::fill(counts, 0.0);
      for (const Sample& sample : samples.of(v)) {
        for (std::size_t h = 0; h < heads; ++h) {
          const TextureMap* map = maps[sample.picture][h].get();
          has[h] = map != nullptr;
          if (!has[h]) continue;
          detail[h] = numbers_at(*map, sample.texel);
          for (std::size_t c = 0; c < 3; ++c) {
            detail[h] -=
                sample.shares[c] * statistics.coarse[h].row(sample.vertices[c]).array().transpose();
          }
        }
        for (std::size_t a = 0; a < heads; ++a) {
          for (std::size_t b = 0; has[a] && b <= a; ++b) {
            if (!has[b]) continue;
            sums[statistics.pair(a, b)] += static_cast<double>((detail[a] * detail[b]).sum());
            counts[statistics.pair(a, b)] += 1;
          }
        }
      }
      for (std::size_t p = 0; p < statistics.pairs; ++p) {
        const std::size_t at = static_cast<std::size_t>(v) * statistics.pairs + p;
        if (counts[p] == 0) continue;
        is_known[at] = 1;
        statistics.covariances[at] = static_cast<float>(sums[p] / counts[p]);
      }
    }
  });
  known.assign(is_known.begin(), is_known.end());
}

/// Pairs of heads that have something at the same vertices are smoothed together, some at a time.
void smooth_covariances(const SmoothingOperator& smoothing, std::uint64_t level,
                        const std::vector<bool>& known, SurfaceStatistics& statistics) {
  constexpr std::size_t kMostAtOnce = 8;
  const std::size_t pairs = statistics.pairs, vertices = known.size() / pairs;
  const auto alike = [&](std::size_t a, std::size_t b) {
    for (std::size_t v = 0; v < vertices; ++v) {
      if (known[v * pairs + a] != known[v * pairs + b]) return false;
    }
    return true;
  };
  for (std::size_t first = 0; first < pairs;) {
    throw_if_interrupted();
    std::size_t end = first + 1;
    while (end < pairs && end - first < kMostAtOnce && alike(first, end)) ++end;
    const auto count = static_cast<Index>(end - first);
    Columns values = Columns::Zero(static_cast<Index>(vertices), count + 1);
    for (std::size_t v = 0; v < vertices; ++v) {
      if (!known[v * pairs + first]) continue;
      const auto row = static_cast<Index>(v);
      for (Index p = 0; p < count; ++p) {
        values(row, p) = statistics.covariances[v * pairs + first + static_cast<std::size_t>(p)];
      }
      values(row, count) = 1;
    }
    smooth_known(smoothing, level, values);
    for (std::size_t v = 0; v < vertices; ++v) {
      for (Index p = 0; p < count; ++p) {
        statistics.covariances[v * pairs + first + static_cast<std::size_t>(p)] =
            static_cast<float>(values(static_cast<Index>(v), p));
      }
    }
    first = end;
  }
}

}  // namespace

SurfaceStatistics surface_statistics(const Adjacency& adjacency,
                                     const std::vector<SurfaceTexels>& texels, const HeadMaps& maps,
                                     const StatisticsScale& scale) {
  SurfaceStatistics statistics;
  if (maps.empty()) return statistics;
  const std::size_t heads = maps.front().size();
  const auto vertices = static_cast<std::size_t>(adjacency.vertex_count());
  const SmoothingOperator smoothing(adjacency, Boundary::kFree, OperatorKind::kLazy);
  const Grouped<Sample> samples = sample_surface(texels, vertices);
  for (std::size_t h = 0; h < heads; ++h) {
    throw_if_interrupted();
    statistics.coarse.push_back(coarse_colours(samples, maps, h, smoothing, scale.detail));
  }
  statistics.pairs = heads * (heads + 1) / 2;
  statistics.covariances.assign(vertices * statistics.pairs, 0);
  std::vector<bool> known(statistics.covariances.size());
  multiply_details(samples, maps, statistics, known);
  smooth_covariances(smoothing, scale.strength, known, statistics);
  return statistics;
}

}  // namespace crowdface
