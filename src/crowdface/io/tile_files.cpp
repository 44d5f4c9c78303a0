// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/tile_files.h"

#include <algorithm>
#include <string>

#include <unistd.h>

#include "crowdface/core/error.h"
#include "crowdface/core/folder.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"

namespace crowdface {

namespace fs = std::filesystem;

int tile_number(double column, double row) {
  if (column >= 0 && column < 10 && row >= 0 && row < 900) {
    const int number = kFirstTile + static_cast<int>(column) + 10 * static_cast<int>(row);
    if (number <= kLastTile) return number;
  }
  throw InvalidInput(concat("expected texture coordinates inside the UDIM tiles ", kFirstTile,
                            " to ", kLastTile, ", u in [0, 10] and v in [0, 900], found the tile ",
                            "at column ", column, ", row ", row));
}

fs::path udim_tile_path(const fs::path& path, int tile) {
  std::string text = path.string();
  for (auto at = text.find(kTileWord); at != text.npos; at = text.find(kTileWord)) {
    text.replace(at, kTileWord.size(), concat(tile));
  }
  return text;
}

std::vector<fs::path> find_tiles(const fs::path& path) {
  constexpr std::size_t kDigits = 4;
  const fs::path name = path.filename();
  const std::size_t at = name.string().find(kTileWord);
  if (at == std::string::npos) return {};
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<fs::path> tiles;
  if (::access(folder.c_str(), R_OK | X_OK) != 0) return tiles;
  for (const fs::path& entry : list_folder(folder)) {
    throw_if_interrupted();
    const std::string found = entry.filename().string();
    if (found.size() < at + kDigits) continue;
    const std::string number = found.substr(at, kDigits);
    const bool digits = std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
    if (digits && udim_tile_path(name, std::stoi(number)) == fs::path(found)) {
      tiles.push_back(path.parent_path() / found);
    }
  }
  return tiles;
}

}  // namespace crowdface
