// SPDX-License-Identifier: Apache-2.0
#include "crowdface/bake/filtered_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

constexpr int kBlockSide = 4;
/// FilteredTexture::mean_at takes at most kMaxTaps samples along each side of its parallelogram.
constexpr int kMaxTaps = 6;
constexpr int kLevelRows = 16;

std::vector<float> values_of(const MapCoding& coding) {
  std::vector<float> values(65536);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = coding.content == MapContent::kColours ? light_of_density(static_cast<float>(i))
                                                       : coding.decode(static_cast<StoredValue>(i));
  }
  return values;
}

constexpr int kLobes = 3;
using LanczosWeights = std::array<float, 2 * kLobes>;

/// Lanczos weights of the six texels around a position (Duchon 1979).
/// \param t  distance, in texels, from the centre of the third texel to the position; 0 to 1
LanczosWeights lanczos_weights(double t) {
  LanczosWeights weights;
  float sum = 0;
  for (int i = 0; i < 2 * kLobes; ++i) {
    const double x = std::numbers::pi * (t + kLobes - 1 - i);
    const bool is_centre = std::abs(x) < 1e-6;
    weights[static_cast<std::size_t>(i)] =
        is_centre ? 1 : static_cast<float>(kLobes * std::sin(x) * std::sin(x / kLobes) / (x * x));
    sum += weights[static_cast<std::size_t>(i)];
  }
  for (float& weight : weights) weight /= sum;
  return weights;
}

Eigen::Array4f with_full_weight(const Eigen::Array3f& value) {
  return {value[0], value[1], value[2], 1};
}

int taps_of(double length) {
  return std::clamp(static_cast<int>(std::lround(length)), 1, kMaxTaps);
}

}  // namespace

FilteredTexture::FilteredTexture(TextureMap map, std::vector<bool> covered)
    : map_(std::move(map)), decoded_values_(values_of(map_.coding)), covered_(std::move(covered)) {
  require(covered_.size() == map_.texel_count(), "coverage of ", covered_.size(), " texels");
  int width = map_.width, height = map_.height;
  while (std::max(width, height) > kBlockSide) {
    const int finer_width = width, finer_height = height;
    width = (width + kBlockSide - 1) / kBlockSide;
    height = (height + kBlockSide - 1) / kBlockSide;
    const std::size_t finer = levels_.size();
    Level level{width, height, {}};
    level.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    parallel_for_each(height, kLevelRows, [&](int y) {
      for (int x = 0; x < width; ++x) {
        Eigen::Array4f sum = Eigen::Array4f::Zero();
        for (int j = 0; j < kBlockSide; ++j) {
          for (int i = 0; i < kBlockSide; ++i) {
            const int fine_x = kBlockSide * x + i, fine_y = kBlockSide * y + j;
            if (fine_x < finer_width && fine_y < finer_height) sum += texel(finer, fine_x, fine_y);
          }
        }
        level.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x)] = sum / (kBlockSide * kBlockSide);
      }
    });
    levels_.push_back(std::move(level));
  }
}

Eigen::Array3f FilteredTexture::stored_value(int x, int y) const {
  Eigen::Array3f value;
  for (int c = 0; c < 3; ++c) {
    const int plane = std::min(c, map_.coding.channels - 1);
    value[c] = decoded_values_[map_.row(plane, y)[x]];
  }
  return value;
}

Eigen::Array4f FilteredTexture::texel(std::size_t level, int x, int y) const {
  if (level > 0) {
    const Level& coarse = levels_[level - 1];
    return coarse.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(coarse.width) +
                         static_cast<std::size_t>(x)];
  }
  return is_covered(x, y) ? with_full_weight(stored_value(x, y))
                          : Eigen::Array4f(Eigen::Array4f::Zero());
}

Eigen::Array4f FilteredTexture::sample_linear(std::size_t level, double x, double y) const {
  const int width = level > 0 ? levels_[level - 1].width : map_.width;
  const int height = level > 0 ? levels_[level - 1].height : map_.height;
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const auto right_share = static_cast<float>(x - 0.5 - left);
  const auto low_share = static_cast<float>(y - 0.5 - top);
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const float share =
          (i == 0 ? 1 - right_share : right_share) * (j == 0 ? 1 - low_share : low_share);
      sum += share * texel(level, std::clamp(static_cast<int>(left) + i, 0, width - 1),
                           std::clamp(static_cast<int>(top) + j, 0, height - 1));
    }
  }
  return sum;
}

Eigen::Array4f FilteredTexture::sample_lanczos(double x, double y) const {
  const auto left = static_cast<int>(std::floor(x - 0.5)) - kLobes + 1;
  const auto top = static_cast<int>(std::floor(y - 0.5)) - kLobes + 1;
  constexpr int kSide = 2 * kLobes;
  if (left < 0 || top < 0 || left + kSide > map_.width || top + kSide > map_.height) {
    return sample_linear(0, x, y);
  }
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      if (!is_covered(left + i, top + j)) return sample_linear(0, x, y);
    }
  }
  const LanczosWeights across = lanczos_weights(x - 0.5 - std::floor(x - 0.5));
  const LanczosWeights down = lanczos_weights(y - 0.5 - std::floor(y - 0.5));
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (int j = 0; j < kSide; ++j) {
    Eigen::Array3f row = Eigen::Array3f::Zero();
    for (int i = 0; i < kSide; ++i) {
      row += across[static_cast<std::size_t>(i)] * stored_value(left + i, top + j);
    }
    sum += down[static_cast<std::size_t>(j)] * row;
  }
  if (map_.coding.content == MapContent::kColours) sum = sum.max(0.0F);
  return with_full_weight(sum);
}

Eigen::Array3f FilteredTexture::nearest_texel(double x, double y) const {
  return stored_value(static_cast<int>(std::clamp(x, 0.0, map_.width - 1.0)),
                      static_cast<int>(std::clamp(y, 0.0, map_.height - 1.0)));
}

Eigen::Array3f FilteredTexture::mean_at(const Eigen::Vector2d& uv,
                                        const Eigen::Vector2d& to_right_texel,
                                        const Eigen::Vector2d& to_lower_texel) const {
  constexpr float kMinCovered = 1e-3F;
  const Eigen::Array2d size(map_.width, map_.height);
  const auto in_texels = [&](const Eigen::Vector2d& side) -> Eigen::Vector2d {
    return side.array() * size * Eigen::Array2d(1, -1);
  };
  const Eigen::Vector2d middle(std::clamp(uv.x(), 0.0, 1.0) * size.x(),
                               (1 - std::clamp(uv.y(), 0.0, 1.0)) * size.y());
  Eigen::Vector2d one = in_texels(to_right_texel), other = in_texels(to_lower_texel),
                  place = middle;
  std::size_t level = 0;
  while (std::max(one.norm(), other.norm()) > kMaxTaps && level < levels_.size()) {
    one /= kBlockSide;
    other /= kBlockSide;
    place /= kBlockSide;
    ++level;
  }
  const int columns = taps_of(one.norm()), rows = taps_of(other.norm());
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  if (level == 0 && columns == 1 && rows == 1) {
    sum = sample_lanczos(place.x(), place.y());
  } else {
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) {
        const Eigen::Vector2d tap =
            place + ((i + 0.5) / columns - 0.5) * one + ((j + 0.5) / rows - 0.5) * other;
        sum += sample_linear(level, tap.x(), tap.y());
      }
    }
  }
  if (sum[3] < kMinCovered) return nearest_texel(middle.x(), middle.y());
  return sum.head<3>() / sum[3];
}

}  // namespace crowdface
