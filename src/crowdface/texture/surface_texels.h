// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Assigns each polygon to one of the texture's images (pictures).
struct TextureLayout {
  /// The size of one image.
  struct Picture {
    int width = 0;   ///< in texels
    int height = 0;  ///< in texels
    bool operator==(const Picture&) const = default;
  };
  std::vector<Picture> pictures;  ///< the images
  /// one per polygon: index into `pictures`, or kNoIndex
  std::vector<std::uint32_t> picture_of_polygon;
  /// For each polygon: the lower corner (u, v) of the unit square of texture space that contains
  /// the polygon.
  std::vector<std::array<std::int32_t, 2>> tile_of_polygon;
  bool operator==(const TextureLayout&) const = default;
};

/// The mesh rasterized into one texture image: for each texel, the triangle that covers the texel's
/// centre. If several triangles overlap, the first triangle covers the texel.
class SurfaceTexels {
 public:
  /// A triangle of a polygon's fan. At the centre of texel (x, y), the triangle's second corner has
  /// the barycentric coordinate s[0] + x · s[1] + y · s[2] with s = second_barycentric. The third
  /// corner has the barycentric coordinate t[0] + x · t[1] + y · t[2] with t = third_barycentric.
  struct Triangle {
    std::array<std::uint32_t, 3> corners;  ///< indices into `vertices()`
    /// coefficients of the barycentric coordinates of the second and the third corner, as linear
    /// functions of the texel: constant, factor of x, factor of y
    std::array<float, 3> second_barycentric, third_barycentric;
    std::uint32_t face = 0;  ///< index of the polygon in the topology
  };
  /// The texels [begin, end) of one row that one triangle covers.
  struct Span {
    std::uint32_t triangle;    ///< index of the triangle that covers the texels, see `triangle()`
    std::uint16_t begin, end;  ///< columns; `end` is exclusive
  };
  /// An uncovered texel near the surface (`target`), which gets the colour of a covered texel
  /// (`source`). Such texels keep texture filtering from mixing the background into the surface.
  struct GutterTexel {
    std::uint32_t target, source;  ///< row · width + column of each texel
  };

  /// \throws BrokenPrecondition if a side of the picture is not within 1 … 65,535 texels.
  SurfaceTexels(const Topology& topology, const TextureCoordinates& uvs,
                const TextureLayout& layout, std::uint32_t picture);

  int width() const { return size_.width; }    ///< in texels
  int height() const { return size_.height; }  ///< in texels
  /// Vertices of the triangles in this texture image, ascending.
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }
  /// Returns a triangle. \param t  index of the triangle, such as Span::triangle
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  /// The covered texels of row y, from left to right.
  std::span<const Span> row(int y) const {
    const auto r = static_cast<std::size_t>(y);
    return {spans_.data() + row_begin_[r], row_begin_[r + 1] - row_begin_[r]};
  }
  /// All gutter texels of the image.
  const std::vector<GutterTexel>& gutter() const { return gutter_; }
  /// Number of covered texels.
  std::size_t covered_texel_count() const { return covered_texel_count_; }
  /// Memory of this object, in bytes.
  std::size_t memory_bytes() const;

 private:
  TextureLayout::Picture size_;
  std::vector<std::uint32_t> vertices_;  ///< indices of mesh vertices, see `vertices()`
  std::vector<Triangle> triangles_;
  std::vector<Span> spans_;             ///< the spans of all rows, one row after another
  std::vector<std::size_t> row_begin_;  ///< #rows + 1: index of each row's first span
  std::vector<GutterTexel> gutter_;
  std::size_t covered_texel_count_ = 0;
};

/// The mesh rasterized into each image of a layout.
using LayoutTexels = std::vector<SurfaceTexels>;
/// Rasterizes the mesh into each image of a layout.
std::shared_ptr<const LayoutTexels> rasterize_layout(const Topology& topology,
                                                     const TextureCoordinates& uvs,
                                                     const TextureLayout& layout);

}  // namespace crowdface
