// SPDX-License-Identifier: Apache-2.0
#include "crowdface/morph/band_masks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"
#include "crowdface/core/smooth_step.h"
#include "crowdface/core/text.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

using Eigen::Vector2d;

// Borders between the bands, as parts of the way from mouth to eyes: under the brows, and between
// nose and lips; half as wide to either side as they are soft.
constexpr double kUpperBorder = 1.2, kLowerBorder = 0.24, kSoft = 0.12;
constexpr int kBleed = 6;  // pixels beyond a texture's border

std::uint8_t to_byte(double x) {
  return static_cast<std::uint8_t>(std::floor(255 * x + 0.5));
}

/// One tile: the height of the head at each pixel, where something is painted.
class Tile {
 public:
  explicit Tile(int size) : size_(size), height_(count(), 0), painted_(count(), false) {}

  /// Paints a triangle at places in pixels, heights running evenly between its corners. What is
  /// painted already stays: eyes and lashes may lie over the face's texture.
  void paint(const std::array<Vector2d, 3>& at, const std::array<double, 3>& height) {
    const Vector2d low = at[0].cwiseMin(at[1]).cwiseMin(at[2]);
    const Vector2d high = at[0].cwiseMax(at[1]).cwiseMax(at[2]);
    const double area = cross(at[1] - at[0], at[2] - at[0]);
    if (area == 0) return;
    for (int y = first(low.y()); y <= std::min(size_ - 1, first(high.y()) + 1); ++y) {
      for (int x = first(low.x()); x <= std::min(size_ - 1, first(high.x()) + 1); ++x) {
        const Vector2d p(x + 0.5, y + 0.5);
        const double b = cross(p - at[0], at[2] - at[0]) / area;
        const double c = cross(at[1] - at[0], p - at[0]) / area;
        if (b < -1e-9 || c < -1e-9 || b + c > 1 + 1e-9 || painted_[pixel(x, y)]) continue;
        set(pixel(x, y), height[0] + b * (height[1] - height[0]) + c * (height[2] - height[0]));
      }
    }
  }

  /// Carries what is painted into the pixels beside it.
  void bleed() {
    const std::vector<bool> before = painted_;
    for (int y = 0; y < size_; ++y) {
      for (int x = 0; x < size_; ++x) {
        if (before[pixel(x, y)]) continue;
        double sum = 0;
        int neighbours = 0;
        for (int j = std::max(0, y - 1); j <= std::min(size_ - 1, y + 1); ++j) {
          for (int i = std::max(0, x - 1); i <= std::min(size_ - 1, x + 1); ++i) {
            if (!before[pixel(i, j)]) continue;
            sum += height_[pixel(i, j)];
            ++neighbours;
          }
        }
        if (neighbours > 0) set(pixel(x, y), sum / neighbours);
      }
    }
  }

  std::vector<std::uint8_t> bands(const FaceHeights& heights) const {
    const double face = heights.eyes - heights.mouth;
    const double upper = heights.mouth + kUpperBorder * face;
    const double lower = heights.mouth + kLowerBorder * face, soft = kSoft * face;
    std::vector<std::uint8_t> out(3 * count(), 0);
    for (std::size_t i = 0; i < count(); ++i) {
      if (!painted_[i]) continue;
      const auto top = to_byte(smooth_step(upper - soft, upper + soft, height_[i]));
      const auto bottom = to_byte(smooth_step(lower + soft, lower - soft, height_[i]));
      out[3 * i] = top;
      out[3 * i + 1] = static_cast<std::uint8_t>(255 - top - bottom);
      out[3 * i + 2] = bottom;
    }
    return out;
  }

 private:
  static double cross(const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  }
  static int first(double x) { return std::max(0, static_cast<int>(std::floor(x - 0.5))); }
  std::size_t count() const {
    return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_);
  }
  std::size_t pixel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) +
           static_cast<std::size_t>(x);
  }
  void set(std::size_t i, double height) {
    height_[i] = height;
    painted_[i] = true;
  }

  int size_;
  std::vector<double> height_;
  std::vector<bool> painted_;
};

}  // namespace

std::map<int, std::vector<std::uint8_t>> band_masks(const Mesh& neutral, const FaceHeights& heights,
                                                    int size) {
  require(size >= 1, "a mask of ", size, " pixels");
  if (heights.eyes <= heights.mouth) {
    throw InvalidInput(concat("expected eyes above the mouth, found eyes at ", heights.eyes,
                              " and the mouth at ", heights.mouth));
  }
  const Topology& topology = neutral.topology;
  if (topology.corner_uvs.empty()) throw InvalidInput("a mask needs texture coordinates");
  std::map<int, Tile> tiles;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto corners = topology.face(f);
    std::vector<Vector2d> at;
    Vector2d middle = Vector2d::Zero();
    for (const std::uint32_t uv : topology.face_uvs(f)) {
      if (uv == kNoIndex) throw InvalidInput(concat("face ", f + 1, " has no texture coordinates"));
      at.emplace_back(neutral.uvs.row(uv).transpose());
      middle += at.back();
    }
    middle /= static_cast<double>(at.size());
    const double column = std::floor(middle.x()), row = std::floor(middle.y());
    for (Vector2d& p : at) p = size * Vector2d(p.x() - column, 1 - (p.y() - row));
    const int number = tile_number(column, row);
    Tile& tile = tiles.try_emplace(number, size).first->second;
    for (std::size_t k = 2; k < at.size(); ++k) {
      tile.paint({at[0], at[k - 1], at[k]},
                 {neutral.positions(corners[0], 1), neutral.positions(corners[k - 1], 1),
                  neutral.positions(corners[k], 1)});
    }
  }
  std::map<int, std::vector<std::uint8_t>> out;
  for (auto& [number, tile] : tiles) {
    for (int i = 0; i < kBleed; ++i) tile.bleed();
    out[number] = tile.bands(heights);
  }
  return out;
}

}  // namespace crowdface
