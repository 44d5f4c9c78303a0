// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/screen_quads.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "crowdface/core/parallel.h"

namespace crowdface {
namespace {

constexpr std::size_t kVerticesPerTask = 8192;
constexpr std::size_t kQuadsPerBlock = 16384;

float cross(const Eigen::Array2f& a, const Eigen::Array2f& b) {
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace

void ScreenQuads::project(const std::vector<float>& points, const std::vector<Quad>& quads,
                          float distance, int size) {
  points_ = points.data();
  quads_ = quads;
  const float half_side = 0.5F * static_cast<float>(size);
  projected_.resize(points.size() / 3);
  parallel_for_each(projected_.size(), kVerticesPerTask, [&](std::size_t v) {
    const float* p = points_ + 3 * v;
    const float inverse_depth = distance / (distance - p[2]);
    projected_[v] = {half_side * (1 + p[0] * inverse_depth), half_side * (1 - p[1] * inverse_depth),
                     inverse_depth};
    if (p[2] >= distance) projected_[v].x = std::numeric_limits<float>::infinity();
  });
  squares_per_row_ = (size + kSquareSide - 1) / kSquareSide;
  square_lists_.resize((quads.size() + kQuadsPerBlock - 1) / kQuadsPerBlock);
  parallel_for_each(square_lists_.size(), [&](std::size_t b) {
    SquareLists& squares = square_lists_[b];
    squares.resize(static_cast<std::size_t>(squares_per_row_ * squares_per_row_));
    for (auto& lists : squares) {
      for (auto& list : lists) list.clear();
    }
    const std::size_t end = std::min(quads.size(), (b + 1) * kQuadsPerBlock);
    add_to_squares(quads, b * kQuadsPerBlock, end, projected_, squares_per_row_, squares);
  });
}

void ScreenQuads::nearest_hits(std::array<int, 2> square, const PixelRectangle& pixels,
                               std::span<const PixelSamples* const> samples,
                               std::vector<std::optional<RayHit>>& hits) const {
  const std::array<int, 2> corner = {square[0] * kSquareSide - kRimWidth,
                                     square[1] * kSquareSide - kRimWidth};
  std::array<SampledPixel, kRimmedSide * kRimmedSide> looked{};
  std::uint32_t count = 0;
  bool middles = true;
  const auto for_each_looked = [&](const auto& body) {
    for (int y = pixels.top; y < pixels.bottom; ++y) {
      for (int x = pixels.left; x < pixels.right; ++x) {
        if (const PixelSamples* const here = samples[pixels.index(x, y)]) body(x, y, *here);
      }
    }
  };
  for_each_looked([&](int x, int y, const PixelSamples& here) {
    looked[static_cast<std::size_t>((y - corner[1]) * kRimmedSide + x - corner[0])] = {&here,
                                                                                       count};
    count += here.count();
    middles = middles && here.positions() == std::vector<Eigen::Vector2f>{{0.5F, 0.5F}};
  });
  DepthBuffer fronts(count);
  for (const SquareLists& squares : square_lists_) {
    const auto& lists = squares[static_cast<std::size_t>(square[1] * squares_per_row_ + square[0])];
    for (const auto& list : std::span(lists).first(middles ? 1 : 2)) {
      rasterize_quads(list, quads_, projected_, corner, looked, fronts);
    }
  }
  hits.assign(count, std::nullopt);
  std::size_t i = 0;
  for_each_looked([&](int x, int y, const PixelSamples& here) {
    const Eigen::Vector2f pixel(static_cast<float>(x), static_cast<float>(y));
    for (const Eigen::Vector2f& place : here.positions()) {
      if (fronts.front_quads[i] != DepthBuffer::kNothing)
        hits[i] = hit(fronts.front_quads[i], pixel + place);
      ++i;
    }
  });
}

RayHit ScreenQuads::hit(std::uint32_t front_quad, const Eigen::Array2f& pixel_position) const {
  const std::uint32_t number = front_quad / 2;
  const Quad& quad = quads_[number];
  const bool second = front_quad % 2 == 1;
  const auto& [i, j, k] = kQuadHalves[front_quad % 2];
  const ProjectedVertex &a = projected_[quad[i]], &b = projected_[quad[j]],
                        &c = projected_[quad[k]];
  const auto from = [&](const ProjectedVertex& corner) -> Eigen::Array2f {
    return Eigen::Array2f(corner.x, corner.y) - pixel_position;
  };
  const Eigen::Array3f areas(cross(from(b), from(c)), cross(from(c), from(a)),
                             cross(from(a), from(b)));
  // Perspective-correct interpolation: weights are areas times inverse_depth.
  const Eigen::Array3f shares =
      areas * Eigen::Array3f(a.inverse_depth, b.inverse_depth, c.inverse_depth);
  const float sum = shares.sum();
  const float u = shares[1] / sum, v = shares[2] / sum;
  const auto point = [&](std::uint32_t vertex) {
    return Eigen::Map<const Eigen::Vector3f>(points_ + std::size_t{3} * vertex);
  };
  const Eigen::Vector3f normal =
      (point(quad[j]) - point(quad[i])).cross(point(quad[k]) - point(quad[i]));
  return {number, second ? 1 - u : u, second ? 1 - v : v, areas.sum() / sum, normal};
}

}  // namespace crowdface
