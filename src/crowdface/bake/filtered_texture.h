// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <Eigen/Core>

#include "crowdface/texture/texture_map.h"

namespace crowdface {

/// A texture for area-filtered lookups: colours as linear light, other maps as plain numbers. Texels
/// outside the surface count only where no texel of the surface is near, so that the background of a
/// texture atlas does not mix in.
class FilteredTexture {
 public:
  /// \param covered  #texels, row by row: whether the surface covers the texel's centre.
  FilteredTexture(TextureMap map, std::vector<bool> covered);

  int width() const { return map_.width; }
  int height() const { return map_.height; }

  /// The mean over a parallelogram with the centre `uv`. A parallelogram of one texel or less is
  /// interpolated with Lanczos weights of 6 by 6 texels, which keep fine detail sharper than linear
  /// or cubic interpolation.
  /// \param uv  from 0 to 1; v points up. Coordinates outside are clamped to the border.
  /// \param across, down  the sides of the parallelogram, in units of uv.
  Eigen::Array3f at(const Eigen::Vector2d& uv, const Eigen::Vector2d& across,
                    const Eigen::Vector2d& down) const;

 private:
  /// Means of blocks of 4 by 4 texels of the next finer level, multiplied by their covered share,
  /// which is the fourth number.
  struct Level {
    int width = 0, height = 0;
    std::vector<Eigen::Array4f> texels;
  };

  Eigen::Array3f stored(int x, int y) const;
  bool is_covered(int x, int y) const {
    return covered_[static_cast<std::size_t>(y) * static_cast<std::size_t>(map_.width) +
                    static_cast<std::size_t>(x)];
  }
  Eigen::Array4f texel(std::size_t level, int x, int y) const;
  Eigen::Array4f linear(std::size_t level, double x, double y) const;
  Eigen::Array4f sharp(double x, double y) const;
  Eigen::Array3f uncovered(double x, double y) const;

  TextureMap map_;
  std::vector<float> values_;  ///< #65536: the number of each stored value
  std::vector<bool> covered_;
  std::vector<Level> levels_;  ///< levels from 1 on
};

}  // namespace crowdface
