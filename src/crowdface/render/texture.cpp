// SPDX-License-Identifier: Apache-2.0
#include "crowdface/render/texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace crowdface {

Texture shrunk_texture(int width, int height, int max_px,
                       const std::function<void(int y, std::span<LinearRgb> texels)>& row) {
  const int block = (std::max(width, height) + max_px - 1) / max_px;
  Texture small{std::max(1, width / block), std::max(1, height / block), {}};
  small.texels.assign(
      static_cast<std::size_t>(small.width) * static_cast<std::size_t>(small.height),
      LinearRgb::Zero());
  const auto row_of = [&](int y) {
    return std::span(small.texels)
        .subspan(static_cast<std::size_t>(y) * static_cast<std::size_t>(small.width),
                 static_cast<std::size_t>(small.width));
  };
  if (block == 1) {
    for (int y = 0; y < height; ++y) row(y, row_of(y));
    return small;
  }
  // Divides a side of the original texture into blocks. Returns the index of the first texel of
  // each block, and `texels` as the last element. If `texels` is not a multiple of `blocks`, some
  // blocks are one texel larger than the other blocks.
  const auto block_begins = [](int blocks, int texels) {
    std::vector<std::size_t> begins;
    for (int i = 0; i <= blocks; ++i) {
      begins.push_back(static_cast<std::size_t>(std::int64_t{i} * texels / blocks));
    }
    return begins;
  };
  const std::vector<std::size_t> left = block_begins(small.width, width);
  const std::vector<std::size_t> top = block_begins(small.height, height);
  std::vector<LinearRgb> texels(static_cast<std::size_t>(width));
  for (int y = 0; y < small.height; ++y) {
    const std::span<LinearRgb> sums = row_of(y);
    const std::size_t first = top[static_cast<std::size_t>(y)];
    const std::size_t end = top[static_cast<std::size_t>(y) + 1];
    for (std::size_t j = first; j < end; ++j) {
      row(static_cast<int>(j), texels);
      for (std::size_t x = 0; x < sums.size(); ++x) {
        for (std::size_t i = left[x]; i < left[x + 1]; ++i) sums[x] += texels[i];
      }
    }
    for (std::size_t x = 0; x < sums.size(); ++x) {
      sums[x] /= static_cast<float>((end - first) * (left[x + 1] - left[x]));
    }
  }
  return small;
}

MipMap::MipMap(Texture texture) {
  levels.push_back(std::move(texture));
  while (std::min(levels.back().width, levels.back().height) > 1) {
    const Texture& larger = levels.back();
    const auto row = [&](int y, std::span<LinearRgb> texels) {
      std::copy_n(larger.texels.begin() + std::ptrdiff_t{y} * larger.width, larger.width,
                  texels.begin());
    };
    const int half = std::max(larger.width, larger.height) / 2;
    levels.push_back(shrunk_texture(larger.width, larger.height, half, row));
  }
}

void spread_colours(Texture& texture, std::vector<bool> painted, int steps) {
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
           static_cast<std::size_t>(x);
  };
  for (int step = 0; step < steps; ++step) {
    std::vector<std::size_t> next;
    for (int y = 0; y < texture.height; ++y) {
      for (int x = 0; x < texture.width; ++x) {
        if (painted[at(x, y)]) continue;
        LinearRgb sum = LinearRgb::Zero();
        float count = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, texture.height - 1); ++v) {
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, texture.width - 1); ++u) {
            if (!painted[at(u, v)]) continue;
            sum += texture.texels[at(u, v)];
            ++count;
          }
        }
        if (count == 0) continue;
        texture.texels[at(x, y)] = sum / count;
        next.push_back(at(x, y));
      }
    }
    for (const std::size_t texel : next) painted[texel] = true;
  }
}

namespace {

/// Interpolates bilinearly between the four texels around a point.
/// \param value_of  returns the value of a texel
template <class Value, class ValueOf>
Value interpolated(const Texture& texture, const Eigen::Vector2f& uv, const ValueOf& value_of) {
  // The fraction of a coordinate; std::floor is called only for repeated textures
  const auto within_tile = [](float at) { return at >= 0 && at < 1 ? at : at - std::floor(at); };
  const auto between = [](float place, int count) {
    return std::clamp(place * static_cast<float>(count) - 0.5F, 0.0F,
                      static_cast<float>(count - 1));
  };
  const float x = between(within_tile(uv.x()), texture.width);
  const float y = between(1 - within_tile(uv.y()), texture.height);
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const int right = std::min(left + 1, texture.width - 1);
  const int bottom = std::min(top + 1, texture.height - 1);
  const auto at = [&](int i, int j) -> const Value& {
    return value_of(
        texture.texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(texture.width) +
                       static_cast<std::size_t>(i)]);
  };
  const float s = x - static_cast<float>(left);
  const float t = y - static_cast<float>(top);
  const Value upper = (1 - s) * at(left, top) + s * at(right, top);
  const Value lower = (1 - s) * at(left, bottom) + s * at(right, bottom);
  return (1 - t) * upper + t * lower;
}

}  // namespace

LinearRgb colour_at(const Texture& texture, const Eigen::Vector2f& uv) {
  return interpolated<LinearRgb>(texture, uv,
                                 [](const LinearRgb& texel) -> const LinearRgb& { return texel; });
}

float value_at(const Texture& texture, const Eigen::Vector2f& uv) {
  return interpolated<float>(texture, uv,
                             [](const LinearRgb& texel) -> const float& { return texel[0]; });
}

}  // namespace crowdface
