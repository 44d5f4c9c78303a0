// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/glb_part.h"

#include <gtest/gtest.h>

#include "crowdface/io/glb_template.h"
#include "crowdface/io/image.h"
#include "crowdface/mesh/normals.h"

#include "io/load_glb.h"
#include "support/meshes.h"

namespace crowdface {
namespace {

TEST(GlbPart, StandsBelowTheFaceWithMaterialsOfItsOwn) {
  const Topology face = testing::cube_topology();
  const Positions positions = testing::cube_positions();
  const GlbTemplate form(face, {}, {});
  Topology card = testing::grid_topology(2, 1);
  const Positions card_points = testing::random_positions(6, 3);
  TextureCoordinates uvs(1, 2);
  uvs << 0.25, 0.25;
  card.corner_uvs.assign(8, 0);
  const std::vector<std::uint8_t> pixels = {9, 8, 7, 255, 1, 2, 3, 0};
  using Alpha = GlbMaterial::Alpha;
  const GlbPart part(
      "bob", card, uvs,
      {{"cards", {1, 1, 1, 1}, 0, Alpha::kMask}, {"lens", {1, 0, 0, 0.5F}, {}, Alpha::kBlend}},
      {0, 1}, {{encode_png(2, 1, 4, pixels), "image/png", "strands"}});
  const PlacedGlbPart parts[] = {{&part, &card_points}, {&part, &card_points}};
  const Positions normals = vertex_normals(face, positions);
  const std::string bytes = form.encode(positions, normals, "face", {}, {}, {}, parts).text();
  const tinygltf::Model model = testing::load_glb(bytes);
  ASSERT_EQ(model.nodes.size(), 3U);
  EXPECT_EQ(model.nodes[0].children, (std::vector<int>{1, 2}));
  EXPECT_EQ(model.nodes[2].name, "bob");
  const tinygltf::Mesh& mesh = model.meshes.at(static_cast<std::size_t>(model.nodes[2].mesh));
  ASSERT_EQ(mesh.primitives.size(), 2U);
  const auto& mask = model.materials.at(static_cast<std::size_t>(mesh.primitives[0].material));
  EXPECT_EQ(mask.name, "cards");
  EXPECT_EQ(mask.alphaMode, "MASK");
  EXPECT_TRUE(mask.doubleSided);
  const int texture = mask.pbrMetallicRoughness.baseColorTexture.index;
  const int source = model.textures.at(static_cast<std::size_t>(texture)).source;
  EXPECT_EQ(model.images.at(static_cast<std::size_t>(source)).image, pixels);
  EXPECT_EQ(model.images.at(static_cast<std::size_t>(source)).name, "strands");
  const auto& lens = model.materials.at(static_cast<std::size_t>(mesh.primitives[1].material));
  EXPECT_EQ(lens.alphaMode, "BLEND");
  EXPECT_EQ(lens.pbrMetallicRoughness.baseColorFactor[3], 0.5);

  const auto& accessor =
      model.accessors.at(static_cast<std::size_t>(mesh.primitives[1].attributes.at("POSITION")));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  ASSERT_EQ(accessor.count, 6U);
  const auto* numbers =
      reinterpret_cast<const float*>(model.buffers[0].data.data() + view.byteOffset);
  for (Index v = 0; v < 6; ++v) {
    for (Index c = 0; c < 3; ++c) {
      EXPECT_EQ(numbers[3 * v + c], static_cast<float>(card_points(v, c)));
    }
  }
  const auto& indices = model.accessors.at(static_cast<std::size_t>(mesh.primitives[1].indices));
  const auto& index_view = model.bufferViews.at(static_cast<std::size_t>(indices.bufferView));
  const auto* index = reinterpret_cast<const std::uint32_t*>(
      model.buffers[0].data.data() + index_view.byteOffset + indices.byteOffset);
  EXPECT_EQ(std::vector<std::uint32_t>(index, index + 6),
            (std::vector<std::uint32_t>{1, 2, 5, 1, 5, 4}));
}

TEST(GlbPart, LeavesAFaceWithoutAnyAsItWas) {
  const Topology face = testing::cube_topology();
  const Positions positions = testing::cube_positions();
  const Positions normals = vertex_normals(face, positions);
  const GlbTemplate form(face, {}, {});
  EXPECT_EQ(form.encode(positions, normals, "face").text(),
            form.encode(positions, normals, "face", {}, {}, {}, {}).text());
}

}  // namespace
}  // namespace crowdface
