// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace crowdface {

/// Numbers of UDIM tiles: unit squares of texture space, in rows of ten. kFirstTile is the tile at
/// the origin; kLastTile is the largest four-digit number.
inline constexpr int kFirstTile = 1001, kLastTile = 9999;

/// The number of a tile: kFirstTile + column + 10 · row.
/// \throws InvalidInput unless 0 ≤ column < 10, row ≥ 0 and the number is at most kLastTile.
int tile_number(double column, double row);

/// Placeholder in a file name for the four digits of a UDIM tile.
constexpr std::string_view kTileWord = "<UDIM>";

/// The path with each kTileWord replaced by the tile's number.
std::filesystem::path udim_tile_path(const std::filesystem::path& path, int tile);

/// If the file name of `path` contains kTileWord, returns the tile files that exist, sorted by
/// name. For other paths returns an empty list.
std::vector<std::filesystem::path> find_tiles(const std::filesystem::path& path);

}  // namespace crowdface
