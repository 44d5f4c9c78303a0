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

/// Number of regions in one mask image: each of the channels red, green and blue holds one region.
inline constexpr Index kRegionsPerImage = 3;

/// The mask images of all tiles. `tiles` maps a UDIM number (kFirstTile for an untiled texture) to
/// images of `size` × `size` × 3 bytes, first row at v = 1. Image i holds regions 3·i to 3·i + 2.
/// At a painted texel the channel values of all images sum to 255; other texels are black.
struct PaintedMasks {
  int size = 0;
  std::map<int, std::vector<std::vector<std::uint8_t>>> tiles;

  bool is_tiled() const;  ///< whether the file names need <UDIM>
  std::size_t image_count() const { return tiles.empty() ? 0 : tiles.begin()->second.size(); }
};

/// Paints vertex weights into images in the texture's layout, such that region_weights reads the
/// weights back. Paints each triangle with interpolated weights of its corners, extends the paint a
/// few texels beyond the borders of the UV charts, and then adjusts texels until the sampled
/// weights match the vertex weights as closely as the resolution allows.
/// \param alpha  #V by #R, not negative, rows summing to one.
/// \param has_priority  #V, or empty for all: whether the vertex has priority, as the skin has over
///                      eyes and lashes. Where polygons overlap in the texture, polygons whose
///                      first corner has priority win; otherwise the polygon with the lower index
///                      wins. Only the weights of vertices with priority are matched.
/// \param size   texels per side, at least 1.
/// \throws InvalidInput if there are no texture coordinates, a face lacks them, or a texture
///         coordinate lies outside all UDIM tiles.
PaintedMasks paint_masks(const Topology& topology, const TextureCoordinates& uvs,
                         const RegionWeights::Alpha& alpha, const std::vector<bool>& has_priority,
                         int size);

struct MaskFiles {
  /// #images: paths for the config, with <UDIM> if tiled.
  std::vector<std::filesystem::path> masks;
  /// Path and content of each PNG file.
  std::vector<std::pair<std::filesystem::path, std::string>> files;
};

/// Encodes mask images as PNG.
/// \param path  path of the first image; may contain <UDIM>. If there are several tiles and the
///              path has no <UDIM>, the function adds <UDIM> before the extension. The numbers _2,
///              _3, … of further images go before <UDIM>.
MaskFiles encode_masks(const PaintedMasks& masks, const std::filesystem::path& path);

}  // namespace crowdface
