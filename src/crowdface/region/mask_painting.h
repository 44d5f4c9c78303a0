// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "crowdface/region/region_weights.h"

namespace crowdface {

/// Regions of one mask image: red, green, blue.
inline constexpr Index kRegionsOfImage = 3;

/// Mask images: by tile (UDIM, or kFirstTile alone), for each image `size` × `size` × 3 bytes, first
/// row at v = 1. Image i holds regions 3·i to 3·i + 2; what all images hold of a texel adds up to 255.
struct PaintedMasks {
  int size = 0;
  std::map<int, std::vector<std::vector<std::uint8_t>>> tiles;

  bool tiled() const;  ///< whether they need <UDIM> in their name
  std::size_t image_count() const { return tiles.empty() ? 0 : tiles.begin()->second.size(); }
};

/// Paints weights of vertices into images in the layout of the texture, so that region_weights reads
/// them back: each triangle with what its corners have, evenly between them, and some texels beyond the
/// borders of the layout's charts; then texels are corrected until vertices read back as they should, as
/// far as there are texels enough. Black elsewhere.
/// \param alpha  #V by #R, not negative, rows summing to one.
/// \param first  #V: where faces share a place, those of these vertices count (the skin: eyes and
///               lashes may lie over the face's texture); among equals the first. Empty: all.
/// \param size   texels of a side, at least 1.
/// \throws InvalidInput if there are no texture coordinates, a face lacks them, or one lies outside
///         all UDIM tiles.
PaintedMasks paint_masks(const Topology& topology, const TextureCoordinates& uvs,
                         const RegionWeights::Alpha& alpha, const std::vector<bool>& first,
                         int size);

struct MaskFiles {
  std::vector<std::filesystem::path> masks;  ///< #images: what a config names, with <UDIM> if tiled
  std::vector<std::pair<std::filesystem::path, std::string>> files;  ///< PNG, in memory
};

/// \param path  of the first image, may hold <UDIM>; where there are several tiles and it does not,
///              their number goes before the ending, and _2, _3, … of further images before that.
MaskFiles encode_masks(const PaintedMasks& masks, const std::filesystem::path& path);

}  // namespace crowdface
