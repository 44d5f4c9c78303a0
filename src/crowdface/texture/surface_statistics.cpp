// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/surface_statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "crowdface/core/interrupt.h"
#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

using Colours = SurfaceStatistics::Colours;

/// Largest number of sampled texels; more samples do not improve the means.
constexpr double kMaxSamples = 1 << 21;
constexpr Index kBlock = 1024;

/// A sampled texel and its position on the surface.
struct Sample {
  std::uint32_t picture = 0;  ///< index of the texture image
  std::uint32_t texel = 0;    ///< index in the image: row · width + column
  /// The covering triangle's vertices, and the barycentric coordinates of the texel's centre.
  std::array<std::uint32_t, 3> vertices = {};
  std::array<float, 3> barycentric = {};
};

/// The decoded values of a texel; 0 for channels that the map does not have.
Eigen::Array3f numbers_at(const TextureMap& map, std::uint32_t texel) {
  const auto channels = static_cast<std::size_t>(map.coding.channels);
  const std::span<const StoredValue> stored = map.stored();
  Eigen::Array3f numbers = Eigen::Array3f::Zero();
  for (std::size_t c = 0; c < channels; ++c) {
    numbers[static_cast<Index>(c)] = map.decode(stored[c * map.texel_count() + texel]);
  }
  return numbers;
}

/// Samples every covered texel whose row and column are multiples of `step`. Then, for each vertex
/// without a sample, samples one texel of an adjacent triangle, if such a texel is covered.
/// \param put  put(vertex, sample): receives each sample and the vertex that the sample belongs to.
///             This vertex is the corner of the covering triangle with the largest barycentric
///             coordinate or, for an additional sample, the vertex that had no sample.
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
    const float b = share(triangle.second_barycentric), c = share(triangle.third_barycentric);
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
            const auto nearest = static_cast<std::size_t>(
                std::ranges::max_element(sample.barycentric) - sample.barycentric.begin());
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

CompressedRows<Sample> sample_surface(const std::vector<SurfaceTexels>& texels,
                                      std::size_t vertices) {
  double covered = 0;
  for (const SurfaceTexels& picture : texels)
    covered += static_cast<double>(picture.covered_texel_count());
  const int step = std::max(1, static_cast<int>(std::ceil(std::sqrt(covered / kMaxSamples))));
  return compressed_rows<Sample>(
      vertices, [&](const auto& put) { for_each_sample(texels, step, vertices, put); });
}

/// Smooths vertex data with missing values by normalized convolution. An input row holds three
/// values and the number 1. If the vertex has no values, the input row holds four zeros. Each
/// smoothed value is divided by the fourth number of the smoothed row. Vertices without data nearby
/// get zeros.
/// \param count   number of rows per vertex.
/// \param row_of  row_of(i, vertex): input row i. Called by any thread.
/// \param take    take(i, vertex, row): receives the smoothed row i. Called by any thread.
template <class RowOf, class Take>
void normalized_convolution(const ChebyshevFilter& filter, std::uint64_t level, std::size_t count,
                            const RowOf& row_of, const Take& take) {
  constexpr std::size_t kMaxAtOnce = 4;
  constexpr double kTolerance = 1e-6;  // the values have seven digits
  constexpr float kMinKnown = 1e-3F;
  const ChebyshevSeries series = power_series(OperatorKind::kLazy, level, kTolerance);
  const std::span<const std::uint32_t> vertex_of_row = filter.vertex_of_row();
  const auto for_each_row = [&](const auto& visit) {
    parallel_for_each(static_cast<Index>(vertex_of_row.size()), kBlock,
                      [&](Index row) { visit(static_cast<std::size_t>(row)); });
  };
  std::vector<FilterInput<float>> inputs;
  for (std::size_t first = 0; first < count; first += kMaxAtOnce) {
    throw_if_interrupted();
    inputs.resize(std::min(kMaxAtOnce, count - first),
                  {std::vector<Row<float>>(vertex_of_row.size()), {series}});
    for_each_row([&](std::size_t row) {
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        inputs[i].values[row] = row_of(first + i, vertex_of_row[row]);
      }
    });
    const auto smoothed = filter.run<float>(inputs);
    for_each_row([&](std::size_t row) {
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        Row<float> means = smoothed[i].front()[row];
        const float known = means.value[3];
        for (float& mean : means.value) mean = known > kMinKnown ? mean / known : 0;
        take(first + i, vertex_of_row[row], means);
      }
    });
  }
}

/// Returns the means of a head's three channels over the sampled texels of a vertex, followed by 1;
/// four zeros if the head has no map there.
Row<float> mean_numbers(std::span<const Sample> samples, const HeadMaps& maps, std::size_t head) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  double count = 0;
  for (const Sample& sample : samples) {
    const TextureMap* map = maps[sample.picture][head].get();
    if (map == nullptr) continue;
    sum += numbers_at(*map, sample.texel).cast<double>();
    count += 1;
  }
  if (count == 0) return {};
  const Eigen::Array3f mean = (sum / count).cast<float>();
  return {mean[0], mean[1], mean[2], 1};
}

/// For each vertex and each pair of heads, computes the mean product of both heads' details,
/// without smoothing. The result is NaN at vertices where one of the two heads has no map.
void multiply_details(const CompressedRows<Sample>& samples, const HeadMaps& maps,
                      SurfaceStatistics& statistics) {
  const std::size_t heads = statistics.coarse_values.size(), pairs = statistics.pair_count;
  parallel_blocks(static_cast<Index>(samples.group_count()), kBlock, [&](Index begin, Index end) {
    // Four values for each head: the differences between the map and `coarse_values` in three
    // channels, then 1 if the head has a map and 0 otherwise.
    std::array<std::vector<float>, 4> detail;
    detail.fill(std::vector<float>(heads));
    std::vector<float> sums(pairs), counts(pairs);
    for (Index v = begin; v < end; ++v) {
      std::ranges::fill(sums, 0.0F);
      std::ranges::fill(counts, 0.0F);
      for (const Sample& sample : samples.items_of(v)) {
        for (std::size_t h = 0; h < heads; ++h) {
          const TextureMap* map = maps[sample.picture][h].get();
          Eigen::Array3f difference = Eigen::Array3f::Zero();
          if (map != nullptr) {
            difference = numbers_at(*map, sample.texel);
            for (std::size_t c = 0; c < 3; ++c) {
              difference -= sample.barycentric[c] *
                            statistics.coarse_values[h].row(sample.vertices[c]).array().transpose();
            }
          }
          for (std::size_t c = 0; c < 3; ++c) detail[c][h] = difference[static_cast<Index>(c)];
          detail[3][h] = map != nullptr ? 1.0F : 0.0F;
        }
        const auto& [x, y, z, has] = detail;
        for (std::size_t a = 0; a < heads; ++a) {
          float* const sum = sums.data() + statistics.pair_index(a, 0);
          float* const count = counts.data() + statistics.pair_index(a, 0);
          for (std::size_t b = 0; b <= a; ++b) {
            sum[b] += x[a] * x[b] + y[a] * y[b] + z[a] * z[b];
            count[b] += has[a] * has[b];
          }
        }
      }
      float* const means = statistics.covariances.data() + static_cast<std::size_t>(v) * pairs;
      for (std::size_t p = 0; p < pairs; ++p) means[p] = sums[p] / counts[p];
    }
  });
}

/// Divides the pairs of heads into groups of one to three consecutive pairs. For each pair, the
/// product of both heads' details is smoothed over the mesh. The filter smooths three numbers per
/// vertex, so it smooths the products of a whole group together. All pairs of a group have products
/// at the same vertices: for each texture image, either every pair of the group has the maps of
/// both heads, or none has.
/// \return for each group: the index of its first pair, and the index after its last pair.
std::vector<std::pair<std::size_t, std::size_t>> group_pairs(const HeadMaps& maps) {
  std::vector<std::vector<bool>> known;  // for each pair and picture: whether both heads have a map
  for (std::size_t a = 0; a < maps.front().size(); ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      known.emplace_back();
      for (const auto& of_picture : maps) {
        known.back().push_back(of_picture[a] != nullptr && of_picture[b] != nullptr);
      }
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  for (std::size_t p = 0; p < known.size(); ++p) {
    const bool joins = !ranges.empty() && p - ranges.back().first < 3 && known[p] == known[p - 1];
    if (!joins) ranges.emplace_back(p, p);
    ranges.back().second = p + 1;
  }
  return ranges;
}

void smooth_covariances(const ChebyshevFilter& filter, std::uint64_t level, const HeadMaps& maps,
                        SurfaceStatistics& statistics) {
  const auto ranges = group_pairs(maps);
  const auto of_vertex = [&](std::size_t range, std::uint32_t vertex) {
    return std::span(statistics.covariances)
        .subspan(vertex * statistics.pair_count + ranges[range].first,
                 ranges[range].second - ranges[range].first);
  };
  normalized_convolution(
      filter, level, ranges.size(),
      [&](std::size_t range, std::uint32_t vertex) {
        const std::span<const float> products = of_vertex(range, vertex);
        Row<float> row = {};
        if (std::isnan(products.front())) return row;
        std::ranges::copy(products, row.value);
        row.value[3] = 1;
        return row;
      },
      [&](std::size_t range, std::uint32_t vertex, const Row<float>& means) {
        const std::span<float> products = of_vertex(range, vertex);
        std::copy_n(means.value, products.size(), products.begin());
      });
}

}  // namespace

SurfaceStatistics surface_statistics(const ChebyshevFilter& filter,
                                     const std::vector<SurfaceTexels>& texels, const HeadMaps& maps,
                                     const StatisticsScale& scale) {
  SurfaceStatistics statistics;
  if (maps.empty()) return statistics;
  const std::size_t heads = maps.front().size();
  const auto vertices = static_cast<std::size_t>(filter.vertex_count());
  const CompressedRows<Sample> samples = sample_surface(texels, vertices);
  statistics.coarse_values.assign(heads, Colours(filter.vertex_count(), 3));
  normalized_convolution(
      filter, scale.detail_iterations, heads,
      [&](std::size_t head, std::uint32_t vertex) {
        return mean_numbers(samples.items_of(vertex), maps, head);
      },
      [&](std::size_t head, std::uint32_t vertex, const Row<float>& means) {
        std::copy_n(means.value, 3, statistics.coarse_values[head].row(vertex).data());
      });
  statistics.pair_count = heads * (heads + 1) / 2;
  statistics.covariances.resize(vertices * statistics.pair_count);
  multiply_details(samples, maps, statistics);
  smooth_covariances(filter, scale.covariance_iterations, maps, statistics);
  return statistics;
}

}  // namespace crowdface
