// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "crowdface/render/ray_scene.h"

namespace crowdface {

/// The image is divided into squares of kSquareSide pixels a side. Each square is processed with a
/// rim of kRimWidth pixels, which overlaps the neighbouring squares.
inline constexpr int kLog2SquareSide = 6;
inline constexpr int kSquareSide = 1 << kLog2SquareSide;  ///< side of a square, in pixels
inline constexpr int kRimWidth = 2;  ///< width of the rim around a square, in pixels
/// Side of a square with its rim, in pixels.
inline constexpr int kRimmedSide = kSquareSide + 2 * kRimWidth;

/// The largest number of floats that a SIMD vector holds. Lists that SIMD code reads are padded by
/// this number of entries.
inline constexpr std::size_t kMaxLanes = 16;

/// A vertex projected to the image.
struct alignas(16) ProjectedVertex {
  float x, y;  ///< in pixels; x is infinite for vertices behind the camera
  /// 1/t, where t is the vertex's parameter on its camera ray: 0 at the camera, 1 at the plane z =
  /// 0
  float inverse_depth;
};

/// A quad that overlaps a square of the image or the rim around this square (see kSquareSide), and
/// the quad's bounding box in pixels. The coordinates of the box are relative to the upper left
/// corner of the rim. `right` and `bottom` are inclusive.
struct QuadOnPixels {
  std::uint32_t quad;  ///< index of the quad
  std::uint8_t left, top, right, bottom;
};

/// For each square of an image, row by row, two lists: the quads that may cover the centre of a
/// pixel, and all other quads that overlap the square.
using SquareLists = std::vector<std::array<std::vector<QuadOnPixels>, 2>>;

/// Adds each quad to the lists of all squares of the image that the quad may touch. A quad that
/// touches only the rim of a square is also added to the lists of this square.
/// \param first, end  range of `quads`; `end` is exclusive
/// \param placed  all vertices, projected to the image
/// \param squares_per_row       number of squares in a row
void add_to_squares(std::span<const Quad> quads, std::size_t first, std::size_t end,
                    std::span<const ProjectedVertex> placed, int squares_per_row,
                    SquareLists& squares);

/// The positions of the samples in one pixel, in units of the pixel's side.
class PixelSamples {
 public:
  /// \param positions  sample positions in [0, 1)²
  explicit PixelSamples(std::vector<Eigen::Vector2f> positions);

  /// The positions of all samples, in [0, 1)².
  const std::vector<Eigen::Vector2f>& positions() const { return positions_; }
  /// Number of samples.
  std::uint32_t count() const { return static_cast<std::uint32_t>(positions_.size()); }
  /// The x coordinates of all samples, followed by kMaxLanes NaNs as padding.
  const float* x() const { return x_.data(); }
  /// The y coordinates of all samples, followed by kMaxLanes NaNs as padding.
  const float* y() const { return y_.data(); }

 private:
  std::vector<Eigen::Vector2f> positions_;
  std::vector<float> x_, y_;
};

/// The samples of a pixel: their positions in the pixel, and the index of the first sample among
/// the samples of all pixels.
struct SampledPixel {
  /// positions of the samples in the pixel; null: the pixel has no samples
  const PixelSamples* samples = nullptr;
  std::uint32_t first_sample = 0;  ///< index of the pixel's first sample
};

/// A depth buffer: the nearest quad at each sample. The lists are padded by kMaxLanes.
struct DepthBuffer {
  static constexpr std::uint32_t kNothing = 0xffffffffU;  ///< value in `front_quads`: no quad
  /// for each sample: the nearest quad's inverse depth (see ProjectedVertex); 0: no quad
  std::vector<float> inverse_depth;
  /// for each sample: 2 · index of the nearest quad, plus 1 if the sample is in the quad's second
  /// triangle
  std::vector<std::uint32_t> front_quads;

  /// Creates an empty buffer. \param samples  number of samples
  explicit DepthBuffer(std::size_t samples);
};

/// Corners of the two triangles into which Embree splits a quad.
inline constexpr std::array<std::array<std::size_t, 3>, 2> kQuadHalves = {{{0, 1, 3}, {2, 3, 1}}};

/// Rasterizes the quads of one square of the image (see kSquareSide) into the depth buffer. Of two
/// quads that are equally near, the earlier quad stays. The result has the same bits with every
/// instruction set.
/// \param pixel_quads  the quads that overlap the square or its rim
/// \param placed  all vertices, projected to the image
/// \param corner  image pixel at the upper left corner of the square's rim
/// \param pixels  kRimmedSide² pixels of the square and its rim, row by row
void rasterize_quads(std::span<const QuadOnPixels> pixel_quads, std::span<const Quad> quads,
                     std::span<const ProjectedVertex> placed, std::array<int, 2> corner,
                     std::span<const SampledPixel> pixels, DepthBuffer& fronts);

}  // namespace crowdface
