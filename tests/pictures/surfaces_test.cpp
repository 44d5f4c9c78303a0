// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pictures/surfaces.h"

#include <array>

#include <gtest/gtest.h>

#include "crowdface/io/image.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using testing::TemporaryFolder;

/// A skin of two squares, and a card of one; each has all of its texture.
Inputs skin_and_card(const TemporaryFolder& folder, const std::string& card) {
  Inputs inputs;
  Topology& topology = inputs.head_set.topology;
  topology.vertex_count = 10;
  const std::array<std::uint32_t, 4> corners = {0, 1, 2, 3};
  for (const auto& face :
       {std::array<std::uint32_t, 4>{0, 1, 2, 3}, std::array<std::uint32_t, 4>{1, 4, 5, 2},
        std::array<std::uint32_t, 4>{6, 7, 8, 9}}) {
    topology.add_face(face, corners);
  }
  inputs.head_set.uvs.resize(4, 2);
  inputs.head_set.uvs << 0, 0, 1, 0, 1, 1, 0, 1;
  inputs.adjacency = build_adjacency(topology);
  inputs.components = find_components(inputs.adjacency);
  inputs.materials = {{"paint", "Material25"}, {0, 0, 1}};
  inputs.head_files.emplace_back();
  inputs.head_files[0].path = folder / "head.obj";
  inputs.head_files[0].material_libraries = {"head.mtl"};
  folder.write("head.mtl", "newmtl paint\nmap_d holes.png\nnewmtl Material25\n" + card);
  std::vector<std::uint8_t> stripes;
  for (int i = 0; i < 16 * 16; ++i) stripes.insert(stripes.end(), 3, i % 4 == 0 ? 255 : 0);
  folder.write("holes.png", encode_png(16, 16, 3, stripes));
  folder.write("whole.png", encode_png(16, 16, 3, std::vector<std::uint8_t>(16 * 16 * 3, 255)));
  return inputs;
}

// Cards of lashes and shells over eyes were drawn as black sheets.
TEST(Surfaces, HideWhatIsNotSkinAndLetsOneSeeThrough) {
  const auto kinds = [](const std::string& card) {
    const TemporaryFolder folder;
    return surfaces_of(Config(), skin_and_card(folder, card)).kinds;
  };
  const std::vector<SurfaceKind> all_skin(3, SurfaceKind::kSkin);
  std::vector<SurfaceKind> hidden = all_skin;
  hidden[2] = SurfaceKind::kHidden;
  EXPECT_EQ(kinds("Kd 0 0 0\n"), all_skin) << "the skin's own holes hide nothing";
  EXPECT_EQ(kinds("Kd 0 0 0\nmap_d holes.png\n"), hidden);
  EXPECT_EQ(kinds("Kd 0 0 0\nmap_d whole.png\n"), all_skin);
  EXPECT_EQ(kinds("Kd 0 0 0\nd 0.1\n"), hidden);
}

}  // namespace
}  // namespace crowdface
