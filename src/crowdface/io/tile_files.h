// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace crowdface {

/// Textures beside each other, ten columns to a row, each of side 1 (UDIM): that at the origin, and the last one that
/// has a number of four digits.
inline constexpr int kFirstTile = 1001, kLastTile = 9999;

/// kFirstTile + column + 10 · row. \throws InvalidInput unless 0 ≤ column < 10, 0 ≤ row and that is at most kLastTile.
int tile_number(double column, double row);

/// Stands in a file's name for the number of a UDIM tile, four digits.
constexpr std::string_view kTileWord = "<UDIM>";

/// The path with a tile's number in place of each kTileWord.
std::filesystem::path with_tile(const std::filesystem::path& path, int tile);

/// The tiles that are there, sorted by name, of a path whose last part holds kTileWord; none of
/// another path.
std::vector<std::filesystem::path> find_tiles(const std::filesystem::path& path);

}  // namespace crowdface
