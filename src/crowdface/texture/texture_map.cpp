// SPDX-License-Identifier: Apache-2.0
#include "crowdface/texture/texture_map.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

constexpr int kRowsPerBlock = 16;

/// Filter of one resampled texel: the source texels of a row or column that contribute to it, and
/// their weights.
struct Taps {
  int first = 0;               ///< index of the first source texel
  std::vector<float> weights;  ///< weights of consecutive source texels; they sum to one
};

std::vector<Taps> taps_of(int from, int to) {
  const double scale = static_cast<double>(from) / to, reach = std::max(1.0, scale);
  std::vector<Taps> all;
  for (int i = 0; i < to; ++i) {
    const double centre = (i + 0.5) * scale - 0.5;
    const int first = std::max(0, static_cast<int>(std::floor(centre - reach)) + 1);
    const int last = std::min(from - 1, static_cast<int>(std::ceil(centre + reach)) - 1);
    Taps taps{std::min(first, from - 1), {}};
    double sum = 0;
    for (int j = taps.first; j <= std::max(last, taps.first); ++j) {
      const double weight = std::max(1e-6, 1 - std::abs(j - centre) / reach);
      taps.weights.push_back(static_cast<float>(weight));
      sum += weight;
    }
    for (float& weight : taps.weights) weight = static_cast<float>(weight / sum);
    all.push_back(std::move(taps));
  }
  return all;
}

using TexelRow = std::vector<Eigen::Array3f>;

void add_row(const TexelRow& row, float weight, TexelRow& sum) {
  for (std::size_t x = 0; x < row.size(); ++x) sum[x] += weight * row[x];
}

}  // namespace

TextureMap make_texture_map(int width, int height, const ImageRows& picture,
                            const MapCoding& coding) {
  require(width > 0 && height > 0 && picture.width > 0 && picture.height > 0, "a texture of ",
          width, " x ", height, " texels of one of ", picture.width, " x ", picture.height);
  const std::vector<Taps> across = taps_of(picture.width, width);
  const std::vector<Taps> down = taps_of(picture.height, height);
  TextureMap map{width, height, {}, coding};
  map.planes.resize(static_cast<std::size_t>(coding.channels) * static_cast<std::size_t>(width) *
                    static_cast<std::size_t>(height));
  const bool same_size = width == picture.width && height == picture.height;
  if (same_size && picture.read_densities && coding.content == MapContent::kColours) {
    parallel_for_each(height, [&](int y) {
      picture.read_densities(y, {map.row(0, y), map.row(1, y), map.row(2, y)});
    });
    return map;
  }
  const auto write = [&](int x, int y, const Eigen::Array3f& numbers) {
    for (int c = 0; c < coding.channels; ++c) {
      map.row(c, y)[x] = coding.content == MapContent::kColours ? density_of_light(numbers[c])
                                                                : coding.encode(numbers[c]);
    }
  };
  parallel_blocks(height, kRowsPerBlock, [&](int begin, int end) {
    TexelRow row(static_cast<std::size_t>(picture.width)), sum(row.size());
    for (int y = begin; y < end; ++y) {
      if (same_size) {
        picture.read_row(y, row);
        for (int x = 0; x < width; ++x) write(x, y, row[static_cast<std::size_t>(x)]);
        continue;
      }
      const Taps& rows = down[static_cast<std::size_t>(y)];
      std::ranges::fill(sum, Eigen::Array3f::Zero());
      for (std::size_t t = 0; t < rows.weights.size(); ++t) {
        picture.read_row(rows.first + static_cast<int>(t), row);
        add_row(row, rows.weights[t], sum);
      }
      for (int x = 0; x < width; ++x) {
        const Taps& texels = across[static_cast<std::size_t>(x)];
        Eigen::Array3f light = Eigen::Array3f::Zero();
        for (std::size_t t = 0; t < texels.weights.size(); ++t) {
          light += texels.weights[t] * sum[static_cast<std::size_t>(texels.first) + t];
        }
        write(x, y, light);
      }
    }
  });
  return map;
}

std::vector<std::uint8_t> srgb8_of(const TextureMap& map) {
  const std::vector<std::uint8_t>& table = srgb8_by_density();
  const std::span<const StoredValue> stored = map.stored();
  const std::size_t texels = map.texel_count();
  std::vector<std::uint8_t> bytes(stored.size());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < texels; ++i) bytes[3 * i + c] = table[stored[c * texels + i]];
  }
  return bytes;
}

}  // namespace crowdface
