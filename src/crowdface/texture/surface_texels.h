// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface {

/// Which picture of the texture each polygon is painted in.
struct TextureLayout {
  struct Picture {
    int width = 0;   ///< texels
    int height = 0;  ///< texels
  };
  std::vector<Picture> pictures;
  std::vector<std::uint32_t> of_face;             ///< #F pictures, or kNoIndex
  std::vector<std::array<std::int32_t, 2>> tile;  ///< #F, the corner of the unit square it lies in
};

/// Where the surface lies in one picture: for every texel whose centre is covered the triangle that covers
/// it, of several the first.
class SurfaceTexels {
 public:
  /// One of a polygon's fan. At the centre of texel (x, y) its second corner has the share
  /// second[0] + x · second[1] + y · second[2], and so on.
  struct Triangle {
    std::array<std::uint32_t, 3> corners;  ///< vertices, as numbers in `vertices()`
    std::array<float, 3> second, third;
    std::uint32_t face = 0;
  };
  /// Covered texels of one row and triangle: [begin, end).
  struct Span {
    std::uint32_t triangle;
    std::uint16_t begin, end;
  };
  /// A texel beside the surface, and the covered one whose colour it takes, so that filtering does not
  /// bring in what lies beyond.
  struct Gutter {
    std::uint32_t to, from;  ///< row · width + column
  };

  /// \throws BrokenPrecondition if a side is beyond 65,535.
  SurfaceTexels(const Topology& topology, const TextureCoordinates& uvs,
                const TextureLayout& layout, std::uint32_t picture);

  int width() const { return size_.width; }
  int height() const { return size_.height; }
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }  ///< ascending
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  std::span<const Span> row(int y) const {
    const auto r = static_cast<std::size_t>(y);
    return {spans_.data() + row_begin_[r], row_begin_[r + 1] - row_begin_[r]};
  }
  const std::vector<Gutter>& gutter() const { return gutter_; }
  std::size_t covered() const { return covered_; }
  std::size_t memory_bytes() const;

 private:
  TextureLayout::Picture size_;
  std::vector<std::uint32_t> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<Span> spans_;
  std::vector<std::size_t> row_begin_;  ///< height + 1
  std::vector<Gutter> gutter_;
  std::size_t covered_ = 0;
};

}  // namespace crowdface
