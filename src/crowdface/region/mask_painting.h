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

/// The mask images of all tiles. Image i of a tile holds regions 3·i to 3·i + 2. At a painted texel
/// the channel values of all images sum to 255; other texels are black.
struct PaintedMasks {
  /// 3 · `texels_per_side`² bytes, row by row from v = 1 down
  using ImageBytes = std::vector<std::uint8_t>;

  int texels_per_side = 0;  ///< width and height of each image
  /// the images of each tile, by the tile's UDIM number (kFirstTile for an untiled texture)
  std::map<int, std::vector<ImageBytes>> images_by_tile;

  /// Whether the file names need <UDIM>: whether there are several tiles, or one tile that is not
  /// kFirstTile.
  bool is_tiled() const;
  /// Number of images of each tile.
  std::size_t image_count() const {
    return images_by_tile.empty() ? 0 : images_by_tile.begin()->second.size();
  }
};

/// Paints vertex weights into mask images with the mesh's texture coordinates, such that
/// `region_weights` reads the same weights from the images. Paints each triangle with the
/// interpolated weights of its corners, extends the paint a few texels beyond the borders of the UV
/// charts, and then adjusts texels until weights sampled from the images match the vertex weights
/// as closely as the resolution allows.
/// \param alpha  #V by #R, not negative, rows summing to one.
/// \param has_priority  one entry per vertex, or empty if all vertices have priority: whether the
///                      vertex has priority over other vertices; for example, skin has priority
///                      over eyes and lashes. Where polygons overlap in the texture, polygons whose
///                      first corner has priority win; otherwise the polygon with the lower index
///                      wins. Only the weights of vertices with priority are matched.
/// \param size   texels per side, at least 1.
/// \param mesh_name  name or file of the mesh, for messages.
/// \throws InvalidInput if there are no texture coordinates, a polygon lacks texture coordinates,
///         or a texture coordinate lies outside all UDIM tiles.
PaintedMasks paint_masks(const Topology& topology, const TextureCoordinates& uvs,
                         const RegionWeights::Alpha& alpha, const std::vector<bool>& has_priority,
                         int size, const std::string& mesh_name = "the mesh");

/// Mask images as files, and their paths for a config.
struct MaskFiles {
  /// Path of each mask image, as it stands in a config; contains <UDIM> if the masks are tiled.
  std::vector<std::filesystem::path> mask_paths;
  /// Path and content of each PNG file.
  std::vector<std::pair<std::filesystem::path, std::string>> png_files;
};

/// Encodes mask images as PNG.
/// \param path  path of the first image; may contain <UDIM>. If the masks are tiled and the path
///              has no <UDIM>, the function adds <UDIM> before the extension. The names of further
///              images have the numbers _2, _3, …, which stand before <UDIM>.
MaskFiles encode_masks(const PaintedMasks& masks, const std::filesystem::path& path);

}  // namespace crowdface
