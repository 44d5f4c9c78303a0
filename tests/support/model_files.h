// SPDX-License-Identifier: Apache-2.0
// Tiny stand-ins for the morphable models that users bring, in the models' own file formats.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/mesh/topology.h"

namespace crowdface::testing {

/// A tube with eyes, teeth and a joint in place of MakeHuman's base mesh, with every target that
/// heads may need and one more.
struct MakeHumanStandIn {
  static constexpr std::uint32_t kColumns = 8, kRows = 12;
  std::vector<std::string> targets;  ///< paths, sorted
  Index vertex_count = 0;

  /// The displacement that the file holds, in thousandths.
  static int thousandths(std::size_t target, std::size_t vertex, std::size_t axis) {
    return static_cast<int>((target * 131 + vertex * 17 + axis * 7) % 41) - 20;
  }
};
MakeHumanStandIn write_makehuman(const std::filesystem::path& package);

/// Adds what heads of that package wear: eyes (each with a clear cornea before it), teeth, tongue, brows, lashes,
/// hair and beards, squares all; and skins of one colour each, which skin_grey tells.
void write_makehuman_wardrobe(const std::filesystem::path& package);
/// The sRGB value of all texels of a skin, by the name of its folder.
int skin_grey(const std::string& folder);
/// Of the squares: their vertices hang on these vertices of the base mesh, in the tube's upper rows, by 1/2, 1/4 and
/// 1/4.
inline constexpr std::array<std::uint32_t, 3> kAttachmentAnchors = {88, 89, 90};
inline constexpr double kAttachmentSide = 0.1;

/// A grid with eyeballs and teeth in place of ICT's neutral mesh, and `modes` identity modes: mode k
/// moves vertex v by (k + 1)/100 · (v mod 3, 1, −1).
void write_ict(const std::filesystem::path& checkout, int modes);

}  // namespace crowdface::testing
