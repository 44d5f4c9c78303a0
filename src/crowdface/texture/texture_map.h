// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "crowdface/core/file.h"
#include "crowdface/texture/optical_density.h"

namespace crowdface {

/// What the numbers of a map are.
enum class MapContent {
  kColours,  ///< optical densities of red, green and blue
  kSlopes,   ///< of a tangent-space normal: how far it leans to the right and upwards, x/z and y/z
  kValues,   ///< one or three plain numbers, such as a roughness or a height
};

/// How a map's numbers lie in 16 bits: number = low + step · what is stored.
struct MapCoding {
  MapContent content = MapContent::kColours;
  int channels = 3;
  float low = 0;
  float step = 1;

  float number(Density stored) const { return low + step * static_cast<float>(stored); }
  /// The nearest.
  Density stored(float number) const;

  /// Leans of up to 83°, in steps of less than 0.02°; no lean has a step of its own.
  static MapCoding slopes() { return {MapContent::kSlopes, 2, -8, 16.0F / 65534}; }
  /// \param channels  1 or 3. \param low, high  what all numbers lie between.
  static MapCoding values(int channels, float low = 0, float high = 1) {
    return {MapContent::kValues, channels, low, high > low ? (high - low) / 65535 : 1};
  }
};

/// What one head has in one picture of the texture.
struct TextureMap {
  int width = 0;
  int height = 0;
  std::vector<Density> planes;  ///< a channel each: height · width, first row on top: v = 1
  MapCoding coding = {};
  std::shared_ptr<const MappedFile> scratch =
      {};  ///< where the planes lie instead, see move_to_disk

  float number(Density stored) const { return coding.number(stored); }
  std::size_t texels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  /// All planes, wherever they lie.
  std::span<const Density> stored() const {
    if (scratch == nullptr) return planes;
    const std::string_view bytes = scratch->bytes();
    return {reinterpret_cast<const Density*>(bytes.data()), bytes.size() / sizeof(Density)};
  }
  const Density* row(int channel, int y) const { return stored().data() + first_of(channel, y); }
  /// Of a map that lies in memory.
  Density* row(int channel, int y) { return planes.data() + first_of(channel, y); }

 private:
  std::size_t first_of(int channel, int y) const {
    return (static_cast<std::size_t>(channel) * static_cast<std::size_t>(height) +
            static_cast<std::size_t>(y)) *
           static_cast<std::size_t>(width);
  }
};

/// Moves a map's planes out of memory into a nameless file of that folder, from which the system reads what
/// is asked for. \throws CannotCreate, IoError.
void move_to_disk(TextureMap& map, const std::filesystem::path& folder);

/// A picture that is read row by row, by any thread: linear light, or the first numbers of each texel as a
/// coding has them.
struct LightRows {
  int width = 0;
  int height = 0;
  std::function<void(int y, std::span<Eigen::Array3f> texels)> row;  ///< writes `width` texels
  /// Of light alone, and perhaps none: writes row y as densities, what density_of_light says of each number, without
  /// a logarithm for each. \param planes  red, green, blue
  std::function<void(int y, const std::array<Density*, 3>& planes)> densities = {};
};

/// The picture at another size: between texels along straight lines where it grows, and where it shrinks
/// each texel is the weighted mean of those around it (a tent as wide as two of the new texels). Of the
/// same size it stays as it is.
TextureMap make_texture_map(int width, int height, const LightRows& picture,
                            const MapCoding& coding = {});

/// Its colours as 8-bit sRGB, height · width · 3.
std::vector<std::uint8_t> srgb8_of(const TextureMap& map);

}  // namespace crowdface
