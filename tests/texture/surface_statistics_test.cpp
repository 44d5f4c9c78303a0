// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/surface_statistics.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"
#include "crowdface/smooth/iterate.h"

#include "texture/two_charts.h"

namespace crowdface {
namespace {

using testing::TwoCharts;

/// What `visit(texel, vertices, shares)` is called with for all covered texels, one after the other.
template <class Visit>
void for_each_texel(const SurfaceTexels& texels, const Visit& visit) {
  for (int y = 0; y < texels.height(); ++y) {
    for (const SurfaceTexels::Span& span : texels.row(y)) {
      const SurfaceTexels::Triangle& triangle = texels.triangle(span.triangle);
      for (int x = span.begin; x < span.end; ++x) {
        const auto share = [&](const std::array<float, 3>& of) {
          return of[0] + static_cast<float>(x) * of[1] + static_cast<float>(y) * of[2];
        };
        const float b = share(triangle.second_barycentric), c = share(triangle.third_barycentric);
        std::array<Index, 3> vertices{};
        for (std::size_t i = 0; i < 3; ++i) vertices[i] = texels.vertices()[triangle.corners[i]];
        visit(static_cast<std::size_t>(y * texels.width() + x), vertices,
              std::array<float, 3>{1 - b - c, b, c});
      }
    }
  }
}

/// Sums of rows over the texels next to each vertex, divided by their count and smoothed by the definition.
template <class RowOfTexel>
Columns means_by_iteration(const TwoCharts& sheet, std::uint64_t level, Index columns,
                           const RowOfTexel& row_of) {
  Columns sums = Columns::Zero(sheet.faces.topology.vertex_count, columns + 1);
  for_each_texel(sheet.texels(), [&](std::size_t texel, const auto& vertices, const auto& shares) {
    const auto nearest = std::ranges::max_element(shares) - shares.begin();
    auto row = sums.row(vertices[static_cast<std::size_t>(nearest)]);
    row.head(columns) += row_of(texel, vertices, shares);
    row[columns] += 1;
  });
  for (Index v = 0; v < sums.rows(); ++v) {
    if (sums(v, columns) > 0) sums.row(v) /= sums(v, columns);
  }
  const SmoothingOperator lazy(sheet.adjacency, Boundary::kFree, OperatorKind::kLazy);
  sums = iterate(lazy, sums, level);
  return sums.leftCols(columns).array().colwise() / sums.col(columns).array();
}

TEST(SurfaceStatistics, AreMeansSmoothedByIteration) {
  TwoCharts sheet(256);
  for (std::uint64_t h = 0; h < 2; ++h) {
    sheet.add_head([h](double x, double y, int column, int row) -> Eigen::Array3f {
      const float noise = static_cast<float>(random_uniform(
          {.seed = h + 1, .index = static_cast<std::uint64_t>(row * 4096 + column)}));
      return Eigen::Array3f(static_cast<float>(x), static_cast<float>(y), 0.5F) * noise;
    });
  }
  sheet.add_bare_head();
  const StatisticsScale scale{.detail_iterations = 9, .covariance_iterations = 40};
  const SmoothingOperator umbrella(sheet.adjacency, Boundary::kFree, OperatorKind::kUmbrella);
  const ChebyshevFilter filter(umbrella, Positions::Zero(sheet.faces.topology.vertex_count, 3));
  const SurfaceStatistics statistics =
      surface_statistics(filter, {sheet.texels()}, sheet.textures.maps, scale);

  const auto numbers = [&](std::size_t head, std::size_t texel) {
    const TextureMap& map = *sheet.textures.maps[0][head];
    Eigen::RowVector3d row;
    for (std::size_t c = 0; c < 3; ++c) {
      row[static_cast<Index>(c)] = map.decode(map.stored()[c * map.texel_count() + texel]);
    }
    return row;
  };
  for (std::size_t h = 0; h < 2; ++h) {
    const Columns expected = means_by_iteration(
        sheet, scale.detail_iterations, 3,
        [&](std::size_t texel, const auto&, const auto&) { return numbers(h, texel); });
    EXPECT_LT((statistics.coarse_values[h].cast<double>() - expected).cwiseAbs().maxCoeff(),
              1e-5 * expected.maxCoeff());
  }
  EXPECT_TRUE(statistics.coarse_values[2].isZero()) << "of a head that has nothing";

  const auto detail = [&](std::size_t head, std::size_t texel, const auto& vertices,
                          const auto& shares) {
    Eigen::RowVector3d difference = numbers(head, texel);
    for (std::size_t i = 0; i < 3; ++i) {
      difference -= static_cast<double>(shares[i]) *
                    statistics.coarse_values[head].row(vertices[i]).template cast<double>();
    }
    return difference;
  };
  for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>(0, 0), {1, 0}, {1, 1}}) {
    const Columns expected = means_by_iteration(
        sheet, scale.covariance_iterations, 1,
        [&, a = a, b = b](std::size_t texel, const auto& vertices, const auto& shares) -> Columns {
          return (detail(a, texel, vertices, shares) *
                  detail(b, texel, vertices, shares).transpose());
        });
    for (Index v = 0; v < expected.rows(); ++v) {
      EXPECT_NEAR(statistics.covariance(static_cast<std::size_t>(v), a, b), expected(v, 0),
                  1e-4 * expected.cwiseAbs().maxCoeff())
          << a << ' ' << b << " at " << v;
      EXPECT_EQ(statistics.covariance(static_cast<std::size_t>(v), a, 2), 0);
    }
  }
}

}  // namespace
}  // namespace crowdface
