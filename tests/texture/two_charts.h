// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "crowdface/region/region_weights.h"
#include "crowdface/texture/texture_blender.h"

namespace crowdface::testing {

/// A square sheet whose texture is cut along the middle into two charts, one of them upside down.
class TwoCharts {
 public:
  static constexpr int kSide = 40;  ///< quads

  explicit TwoCharts(int size, Index regions = 1) : size_(size) {
    faces.topology.vertex_count = (kSide + 1) * (kSide + 1);
    for (int chart = 0; chart < 2; ++chart) {
      for (int j = 0; j <= kSide; ++j) {
        for (int i = 0; i <= kSide / 2; ++i) {
          add_uv(to_uv(chart, at(i + chart * kSide / 2), at(j)));
        }
      }
    }
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) add_quad(i, j);
    }
    adjacency = build_adjacency(faces.topology);
    alpha = {RegionWeights::Alpha::Zero(faces.topology.vertex_count, regions), 0};
    for (Index v = 0; v < faces.topology.vertex_count; ++v) {
      alpha.alpha(v, v % (kSide + 1) <= kSide / 4 ? 0 : regions - 1) = 1;
    }
    textures.layout.pictures = {{size, size}};
    textures.layout.picture_of_polygon.assign(static_cast<std::size_t>(faces.topology.face_count()),
                                              0);
    textures.layout.tile_of_polygon.assign(textures.layout.picture_of_polygon.size(), {0, 0});
    textures.maps.resize(1);
  }

  using Paint = std::function<Eigen::Array3f(double x, double y, int column, int row)>;
  /// A head whose colours, or other numbers, are a function of the place on the sheet, in [0, 1]²,
  /// and of the texel.
  void add_head(const Paint& paint, const MapCoding& coding = {}) {
    const ImageRows rows{size_, size_, [&](int row, std::span<Eigen::Array3f> texels) {
                           for (int column = 0; column < size_; ++column) {
                             const auto [x, y] =
                                 from_uv((column + 0.5) / size_, 1 - (row + 0.5) / size_);
                             texels[static_cast<std::size_t>(column)] = paint(x, y, column, row);
                           }
                         }};
    textures.maps[0].push_back(
        std::make_shared<const TextureMap>(make_texture_map(size_, size_, rows, coding)));
  }
  void add_bare_head() { textures.maps[0].push_back(nullptr); }

  TextureBlender blender() const {
    TextureBlendOptions options;
    options.vertex_areas.assign(static_cast<std::size_t>(faces.topology.vertex_count), 1.0);
    options.uses_target_colours_only = of_target;
    const ChebyshevFilter filter(SmoothingOperator(adjacency, Boundary::kFree, OperatorKind::kLazy),
                                 Positions::Zero(faces.topology.vertex_count, 3));
    return {faces.topology, rasterize_layout(faces.topology, faces.uvs, textures.layout),
            filter,         alpha,
            textures,       options};
  }
  SurfaceTexels texels() const { return {faces.topology, faces.uvs, textures.layout, 0}; }

  /// Where a place of the sheet is in one of the charts, both of which have the middle.
  static Eigen::RowVector2d to_uv(int chart, double x, double y) {
    if (chart == 0) return {0.05 + 0.8 * x, 0.1 + 0.8 * y};
    return {0.15 + 0.8 * x, 0.9 - 0.8 * y};
  }
  static std::pair<double, double> from_uv(double u, double v) {
    if (u < 0.5) return {(u - 0.05) / 0.8, (v - 0.1) / 0.8};
    return {(u - 0.15) / 0.8, (0.9 - v) / 0.8};
  }

  HeadSet faces;
  Adjacency adjacency;
  RegionWeights alpha;
  CrowdTextures textures;
  std::vector<bool> of_target;

 private:
  static double at(int i) { return static_cast<double>(i) / kSide; }
  void add_uv(const Eigen::RowVector2d& uv) {
    faces.uvs.conservativeResize(faces.uvs.rows() + 1, 2);
    faces.uvs.row(faces.uvs.rows() - 1) = uv;
  }
  void add_quad(int i, int j) {
    const int chart = i < kSide / 2 ? 0 : 1;
    std::vector<std::uint32_t> vertices, uvs;
    for (const auto& [a, b] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      const int column = i + a, row = j + b;
      vertices.push_back(static_cast<std::uint32_t>(row * (kSide + 1) + column));
      const int in_chart = (kSide + 1) * (kSide / 2 + 1) * chart + row * (kSide / 2 + 1) + column -
                           chart * kSide / 2;
      uvs.push_back(static_cast<std::uint32_t>(in_chart));
    }
    faces.topology.add_face(vertices, uvs);
  }

  int size_;
};

}  // namespace crowdface::testing
