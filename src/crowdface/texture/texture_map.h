// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "crowdface/core/file.h"
#include "crowdface/texture/optical_density.h"

namespace crowdface {

/// A number of a texture map, encoded in 16 bits (see MapCoding).
using StoredValue = std::uint16_t;

/// What the values of a texture map mean.
enum class MapContent {
  kColours,  ///< colours, stored as the optical densities of red, green and blue
  kSlopes,   ///< slopes x/z and y/z of a tangent-space normal
  kValues,   ///< one or three plain numbers, such as roughness or height
};

/// The 16-bit encoding of a map's numbers: number = low + step · stored.
struct MapCoding {
  MapContent content = MapContent::kColours;
  int channels = 3;  ///< number of channels of the map
  float low = 0;     ///< the number that the stored value 0 encodes
  float step = 1;    ///< difference between the numbers of adjacent stored values

  /// Decodes a stored value.
  float decode(StoredValue stored) const { return low + step * static_cast<float>(stored); }
  /// Encodes a number: the nearest stored value, clamped to 0 … 65,535.
  StoredValue encode(float number) const {
    return static_cast<StoredValue>(std::clamp((number - low) / step + 0.5F, 0.0F, 65535.0F));
  }

  /// Slopes from −8 to 8, which are angles up to 83° in steps below 0.02°; slope 0 is exactly
  /// representable.
  static MapCoding slope_coding() { return {MapContent::kSlopes, 2, -8, 16.0F / 65534}; }
  /// A coding of plain numbers.
  /// \param channels  1 or 3.
  /// \param low, high  range of all numbers; if both are equal, every stored value encodes this
  ///                   number.
  static MapCoding value_coding(int channels, float low = 0, float high = 1) {
    constexpr float kSmallestStep = std::numeric_limits<float>::min();
    return {MapContent::kValues, channels, low, std::max((high - low) / 65535, kSmallestStep)};
  }
};

/// One head's texture map for one image of the texture layout, in 16-bit planes.
struct TextureMap {
  int width = 0;                    ///< in texels
  int height = 0;                   ///< in texels
  std::vector<StoredValue> planes;  ///< one plane per channel: height by width, first row at v = 1
  MapCoding coding = {};            ///< how the stored values encode numbers
  /// the planes in a mapped file, instead of `planes`
  std::span<const StoredValue> mapped_planes = {};
  std::shared_ptr<const MappedFile> mapped_file = {};  ///< the mapped file; null: `planes` is used

  /// The number that a stored value encodes.
  float decode(StoredValue stored) const { return coding.decode(stored); }
  std::size_t texel_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  /// The stored values of all channels, plane by plane.
  std::span<const StoredValue> stored() const {
    return mapped_file == nullptr ? std::span(planes) : mapped_planes;
  }
  /// The stored values of row y of a channel.
  const StoredValue* row(int channel, int y) const {
    return stored().data() + plane_row_offset(channel, y);
  }
  /// A writable row; only for maps in memory.
  StoredValue* row(int channel, int y) { return planes.data() + plane_row_offset(channel, y); }

 private:
  /// Index of the first texel of row y of a channel in stored().
  std::size_t plane_row_offset(int channel, int y) const {
    return (static_cast<std::size_t>(channel) * static_cast<std::size_t>(height) +
            static_cast<std::size_t>(y)) *
           static_cast<std::size_t>(width);
  }
};

/// A source image that is read row by row, from any thread. Rows contain linear light, or the
/// numbers that a MapCoding encodes.
struct ImageRows {
  int width = 0;
  int height = 0;
  /// Reads row y of the image: writes its `width` texels to `texels`.
  std::function<void(int y, std::span<Eigen::Array3f> texels)> read_row;
  /// Optional, for images that contain linear light: a faster alternative to `read_row` that reads
  /// row y as densities. The result equals density_of_light of each value but needs no logarithms.
  /// \param planes  red, green, blue.
  std::function<void(int y, const std::array<Density*, 3>& planes)> read_densities = {};
};

/// Makes a map from an image and resamples it to `width` by `height`: with linear interpolation to
/// enlarge, and with a tent filter two new texels wide to shrink. An image of the same size is
/// copied exactly.
TextureMap make_texture_map(int width, int height, const ImageRows& picture,
                            const MapCoding& coding = {});

/// The colours of a map as 8-bit sRGB, height by width by 3.
std::vector<std::uint8_t> srgb8_of(const TextureMap& map);

}  // namespace crowdface
