// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/texture/texture_map.h"

namespace crowdface {

/// A texture that returns means over areas: colours as linear light, other maps as plain numbers.
/// Texels outside the surface contribute only if no covered texel is near, so that the background
/// of a texture atlas does not bleed into the surface.
class FilteredTexture {
 public:
  /// \param covered  for each texel, row by row: whether the surface covers the texel's centre.
  FilteredTexture(TextureMap map, std::vector<bool> covered);

  int width() const { return map_.width; }
  int height() const { return map_.height; }

  /// Returns the mean over a parallelogram with the centre `uv`. For a parallelogram of one texel
  /// or less, interpolates with Lanczos weights of 6 by 6 texels, which keep fine detail sharper
  /// than linear or cubic interpolation.
  /// \param uv  from 0 to 1; v points up. Coordinates outside are clamped to the border.
  /// \param to_right_texel, to_lower_texel  the sides of the parallelogram, in units of uv.
  Eigen::Array3f mean_at(const Eigen::Vector2d& uv, const Eigen::Vector2d& to_right_texel,
                         const Eigen::Vector2d& to_lower_texel) const;

 private:
  /// A level of the pyramid: each texel is the mean of 4 by 4 texels of the next finer level. The
  /// fourth number of a texel is the fraction of its area that the surface covers. The first three
  /// numbers are the mean values over the covered area, multiplied by this fraction.
  struct Level {
    int width = 0, height = 0;
    std::vector<Eigen::Array4f> texels;  ///< the texels of the level, row by row: height by width
  };

  /// The value of a texel of the texture, even if the surface does not cover the texel.
  Eigen::Array3f stored_value(int x, int y) const;
  /// Whether the surface covers the centre of a texel.
  bool is_covered(int x, int y) const {
    return covered_[static_cast<std::size_t>(y) * static_cast<std::size_t>(map_.width) +
                    static_cast<std::size_t>(x)];
  }
  /// The four numbers of a texel, see Level. Level 0 is the texture itself.
  Eigen::Array4f texel(std::size_t level, int x, int y) const;
  /// Interpolates the texels of a level linearly. x and y count texels from the upper left corner.
  Eigen::Array4f sample_linear(std::size_t level, double x, double y) const;
  /// Interpolates the texture with Lanczos weights, or linearly near uncovered texels and borders.
  Eigen::Array4f sample_lanczos(double x, double y) const;
  /// The value of the texture's texel nearest to (x, y), whether or not the surface covers this
  /// texel.
  Eigen::Array3f nearest_texel(double x, double y) const;

  TextureMap map_;  ///< the texture itself
  /// the number that each of the 65,536 stored values represents
  std::vector<float> decoded_values_;
  std::vector<bool> covered_;  ///< for each texel: whether the surface covers the texel's centre
  std::vector<Level> levels_;  ///< levels 1, 2, …; level 0 is the texture itself
};

}  // namespace crowdface
