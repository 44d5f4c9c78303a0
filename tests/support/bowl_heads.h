// SPDX-License-Identifier: Apache-2.0
// Small stand-ins for scanned heads, with everything in their files that scans have.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/reference.h"

namespace crowdface::testing {

/// A sheet bent into a bowl about 14 cm wide that opens backwards (−z), with a hole for a mouth:
/// quads, some triangles, a hexagon; beside it a closed cube for an eye and a vertex in no face.
/// Texture coordinates have a seam.
struct Bowl {
  int columns = 9;
  int rows = 10;
  double per_cm = 1;  ///< file units in one centimetre
  int tiles = 1;      ///< UDIM tiles the texture coordinates stretch over, side by side
  bool uvs = true;
  bool normals = false;
  bool materials = false;  ///< names bowl.mtl
  bool crlf = false;
  bool odd_text = false;  ///< comments, tabs, `w`, other group names: all that a reader must bear

  int vertex_count() const { return (columns + 1) * (rows + 1) + 9; }
};

/// The OBJ text of one person's head; the topology is the same for all persons. All numbers are the
/// shortest texts of single-precision values.
std::string bowl_text(const Bowl& bowl, std::uint64_t person);

/// Writes heads/ann.obj, bob, cyd, dan (as many as asked), odd text in the second. \return names.
std::vector<std::string> write_bowls(const std::filesystem::path& folder, const Bowl& bowl,
                                     std::size_t count);

/// Random texels of three channels, some of them black, as an 8-bit picture; `seed` tells them
/// apart.
reference::Picture mask_picture(std::size_t width, std::size_t height, std::uint64_t seed);

/// Writes it as PNG; with alpha, a fourth channel of other numbers is added.
void write_mask(const std::filesystem::path& path, const reference::Picture& picture,
                bool with_alpha = false);

}  // namespace crowdface::testing
