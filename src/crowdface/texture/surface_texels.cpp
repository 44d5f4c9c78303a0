// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/surface_texels.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/require.h"
#include "crowdface/texture/triangle_texels.h"

namespace crowdface {
namespace {

using Point = Eigen::Vector2d;
/// Index of the triangle that covers each texel, or kNoIndex.
using Owners = std::vector<std::uint32_t>;

/// Computes the barycentric coordinates as linear functions of the texel's column and row. Returns
/// false for a triangle without area.
bool set_barycentrics(const std::array<Point, 3>& at, SurfaceTexels::Triangle& triangle) {
  const Point u = at[1] - at[0], v = at[2] - at[0];
  const double area = cross(u, v);
  if (!(std::abs(area) > 1e-12)) return false;
  const Point origin = Point(0.5, 0.5) - at[0];
  triangle.second_barycentric = {static_cast<float>(cross(origin, v) / area),
                                 static_cast<float>(v.y() / area),
                                 static_cast<float>(-v.x() / area)};
  triangle.third_barycentric = {static_cast<float>(cross(u, origin) / area),
                                static_cast<float>(-u.y() / area),
                                static_cast<float>(u.x() / area)};
  return true;
}

/// Width of the gutter in texels: 1/64 of the longer side, at least 4. For a side of 1024 texels
/// the gutter has 16 texels, the size of one texel of mip level 4.
int gutter_width(const TextureLayout::Picture& size) {
  return std::max(4, std::max(size.width, size.height) / 64);
}

std::vector<SurfaceTexels::GutterTexel> grow_gutter(const Owners& owners,
                                                    const TextureLayout::Picture& size) {
  std::vector<bool> taken(owners.size());
  for (std::size_t i = 0; i < owners.size(); ++i) taken[i] = owners[i] != kNoIndex;
  std::vector<SurfaceTexels::GutterTexel> gutter;
  const auto width = static_cast<std::size_t>(size.width);
  const auto grow = [&](std::size_t i, std::uint32_t from) {
    const auto take = [&](std::size_t other) {
      if (taken[other]) return;
      taken[other] = true;
      gutter.push_back({static_cast<std::uint32_t>(other), from});
    };
    if (i % width > 0) take(i - 1);
    if (i % width + 1 < width) take(i + 1);
    if (i >= width) take(i - width);
    if (i + width < owners.size()) take(i + width);
  };
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (owners[i] != kNoIndex) grow(i, static_cast<std::uint32_t>(i));
  }
  std::size_t ring_begin = 0;
  for (int ring = 1; ring < gutter_width(size); ++ring) {
    const std::size_t ring_end = gutter.size();
    for (std::size_t g = ring_begin; g < ring_end; ++g) grow(gutter[g].target, gutter[g].source);
    ring_begin = ring_end;
  }
  return gutter;
}

}  // namespace

SurfaceTexels::SurfaceTexels(const Topology& topology, const TextureCoordinates& uvs,
                             const TextureLayout& layout, std::uint32_t picture)
    : size_(layout.pictures[picture]) {
  require(size_.width > 0 && size_.height > 0 && std::max(size_.width, size_.height) <= 65535,
          "a texture of ", size_.width, " x ", size_.height, " texels");
  const auto width = static_cast<std::size_t>(size_.width);
  // Rasterize all triangles; the first triangle that covers a texel owns it.
  Owners owners(width * static_cast<std::size_t>(size_.height), kNoIndex);
  std::vector<std::uint32_t> corners;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = static_cast<std::size_t>(f);
    if (layout.picture_of_polygon[face] != picture) continue;
    const auto vertices = topology.face(f), face_uvs = topology.face_uvs(f);
    if (std::ranges::count(face_uvs, kNoIndex) > 0) continue;
    const auto at = [&](std::size_t corner) {
      const auto uv = uvs.row(face_uvs[corner]);
      return Point((uv[0] - layout.tile_of_polygon[face][0]) * size_.width,
                   (1 - (uv[1] - layout.tile_of_polygon[face][1])) * size_.height);
    };
    for (std::size_t c = 1; c + 1 < vertices.size(); ++c) {
      const std::array<Point, 3> points = {at(0), at(c), at(c + 1)};
      Triangle triangle{};
      if (!set_barycentrics(points, triangle)) continue;
      const auto number = static_cast<std::uint32_t>(triangles_.size());
      bool any = false;
      for_each_texel(points, size_.width, size_.height, [&](int x, int y) {
        std::uint32_t& owner =
            owners[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
        if (owner != kNoIndex) return;
        owner = number;
        any = true;
      });
      if (!any) continue;
      triangle.face = static_cast<std::uint32_t>(f);
      triangles_.push_back(triangle);
      for (const std::size_t corner : {std::size_t{0}, c, c + 1}) {
        corners.push_back(vertices[corner]);
      }
    }
  }
  vertices_ = renumber(corners, topology.vertex_count);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) triangles_[t].corners[c] = corners[3 * t + c];
  }
  // Convert each row to spans of texels that the same triangle covers.
  row_begin_ = {0};
  for (int y = 0; y < size_.height; ++y) {
    const std::uint32_t* row = owners.data() + static_cast<std::size_t>(y) * width;
    for (std::size_t x = 0; x < width;) {
      const std::size_t begin = x;
      while (x < width && row[x] == row[begin]) ++x;
      if (row[begin] == kNoIndex) continue;
      spans_.push_back(
          {row[begin], static_cast<std::uint16_t>(begin), static_cast<std::uint16_t>(x)});
      covered_texel_count_ += x - begin;
    }
    row_begin_.push_back(spans_.size());
  }
  gutter_ = grow_gutter(owners, size_);
}

std::size_t SurfaceTexels::memory_bytes() const {
  return vertices_.size() * sizeof(vertices_[0]) + triangles_.size() * sizeof(Triangle) +
         spans_.size() * sizeof(Span) + row_begin_.size() * sizeof(row_begin_[0]) +
         gutter_.size() * sizeof(GutterTexel);
}

std::shared_ptr<const LayoutTexels> rasterize_layout(const Topology& topology,
                                                     const TextureCoordinates& uvs,
                                                     const TextureLayout& layout) {
  auto texels = std::make_shared<LayoutTexels>();
  for (std::uint32_t p = 0; p < layout.pictures.size(); ++p) {
    texels->emplace_back(topology, uvs, layout, p);
  }
  return texels;
}

}  // namespace crowdface
