// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/glb_template.h"

#include <cstring>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/io/image.h"
#include "crowdface/mesh/normals.h"

#include "io/load_glb.h"
#include "support/binary_reader.h"
#include "support/expect_error.h"
#include "support/meshes.h"

namespace crowdface {
namespace {

template <class Number>
std::vector<Number> numbers(const tinygltf::Model& model, int accessor_index) {
  const auto& accessor = model.accessors.at(static_cast<std::size_t>(accessor_index));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  EXPECT_EQ(static_cast<std::size_t>(accessor.ByteStride(view)),
            sizeof(Number) * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                                 static_cast<std::uint32_t>(accessor.type))));
  const auto count = accessor.count * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                                          static_cast<std::uint32_t>(accessor.type)));
  std::vector<Number> out(count);
  EXPECT_LE(accessor.byteOffset + count * sizeof(Number), view.byteLength);
  std::memcpy(out.data(), model.buffers.at(0).data.data() + view.byteOffset + accessor.byteOffset,
              count * sizeof(Number));
  return out;
}

std::vector<float> attribute(const tinygltf::Model& model, const std::string& name,
                             std::size_t primitive = 0) {
  return numbers<float>(model, model.meshes.at(0).primitives.at(primitive).attributes.at(name));
}

/// Two quads and a triangle; a seam at vertex 1, two materials, one vertex in no face.
struct SmallMesh {
  Topology topology = testing::make_topology(8, {{0, 1, 2, 3}, {1, 4, 5, 2}, {4, 6, 5}});
  TextureCoordinates uvs = TextureCoordinates::Zero(8, 2);
  GlbOptions options;
  SmallMesh() {
    topology.corner_uvs = {0, 1, 2, 3, 7, 4, 5, 2, 4, 6, 5};
    uvs << 0, 0, 0.25, 0, 0.25, 1, 0, 1, 0.5, 0, 0.5, 1, 1, 0.75, 3.25, 0.125;
    options.unit = LengthUnit::kCentimetre;
    options.materials = {{"skin", {0.8F, 0.6F, 0.5F, 1}}, {"lashes", {0, 0, 0, 0}}};
    options.polygon_materials = {0, 1, 0};
  }
};

TEST(GlbTemplate, ReadsBack) {
  const SmallMesh mesh;
  const Positions positions = 15 * testing::random_positions(8, 1);
  const Positions normals = vertex_normals(mesh.topology, positions);
  const GlbTemplate form(mesh.topology, mesh.uvs, mesh.options);
  const tinygltf::Model model =
      testing::load_glb(form.encode(positions, normals, "mob_0001").text());

  EXPECT_EQ(model.asset.version, "2.0");
  ASSERT_EQ(model.nodes.size(), 1U);
  EXPECT_EQ(model.nodes[0].name, "mob_0001");
  EXPECT_EQ(model.nodes[0].scale, (std::vector<double>{0.01, 0.01, 0.01}));
  EXPECT_TRUE(model.nodes[0].rotation.empty());
  ASSERT_EQ(model.meshes.size(), 1U);
  EXPECT_EQ(model.meshes[0].name, "mob_0001");

  // One more vertex than the mesh: vertex 1 lies at a seam.
  EXPECT_EQ(attribute(model, "_VERTEX_ID"), (std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7, 1}));
  const auto points = attribute(model, "POSITION"), directions = attribute(model, "NORMAL");
  ASSERT_EQ(points.size(), 27U);
  ASSERT_EQ(directions.size(), 27U);
  for (Index i = 0; i < 9; ++i) {
    const Index row = i < 8 ? i : 1;
    for (Index c = 0; c < 3; ++c) {
      EXPECT_EQ(points[static_cast<std::size_t>(3 * i + c)], static_cast<float>(positions(row, c)));
      EXPECT_EQ(directions[static_cast<std::size_t>(3 * i + c)],
                static_cast<float>(normals(row, c)));
    }
  }
  EXPECT_EQ(attribute(model, "TEXCOORD_0"),
            (std::vector<float>{0, 1, 0.25, 1, 0.25, 0, 0, 0, 0.5, 1, 0.5, 0, 1, 0.25, 0, 0, 3.25,
                                0.875}))
      << "v goes down; the vertex in no face has no texture coordinate";
}

TEST(GlbTemplate, HasOnePrimitiveAMaterial) {
  const SmallMesh mesh;
  const Positions positions = testing::random_positions(8, 1);
  const GlbTemplate form(mesh.topology, mesh.uvs, mesh.options);
  const tinygltf::Model model = testing::load_glb(
      form.encode(positions, vertex_normals(mesh.topology, positions), "m").text());
  const auto& primitives = model.meshes[0].primitives;
  ASSERT_EQ(primitives.size(), 2U);
  EXPECT_EQ(numbers<std::uint32_t>(model, primitives[0].indices),
            (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 6, 5}));
  EXPECT_EQ(numbers<std::uint32_t>(model, primitives[1].indices),
            (std::vector<std::uint32_t>{8, 4, 5, 8, 5, 2}));
  ASSERT_EQ(model.materials.size(), 2U);
  const auto& skin = model.materials[static_cast<std::size_t>(primitives[0].material)];
  const auto& lashes = model.materials[static_cast<std::size_t>(primitives[1].material)];
  EXPECT_EQ(skin.name, "skin");
  EXPECT_EQ(skin.pbrMetallicRoughness.baseColorFactor, (std::vector<double>{0.8, 0.6, 0.5, 1}));
  EXPECT_EQ(skin.pbrMetallicRoughness.metallicFactor, 0);
  EXPECT_EQ(skin.alphaMode, "OPAQUE");
  EXPECT_EQ(lashes.name, "lashes");
  EXPECT_EQ(lashes.alphaMode, "BLEND");
}

// Validators complained that viewers had to guess the tangents of a normal map.
TEST(GlbTemplate, HasTangentsWhereItHasANormalMap) {
  // Two quads whose texture is mirrored at their common edge.
  Topology topology = testing::make_topology(6, {{0, 1, 2, 3}, {1, 4, 5, 2}});
  topology.corner_uvs = {0, 1, 2, 3, 1, 0, 3, 2};
  TextureCoordinates uvs(4, 2);
  uvs << 1, 0, 0, 0, 0, 1, 1, 1;
  Positions positions(6, 3), normals(6, 3);
  positions << -1, 0, 0, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1, 0, 0, 1, 1, 0;
  normals.rowwise() = Eigen::RowVector3d(0, 0, 1);
  GlbOptions options;
  options.materials = {{"skin"}};
  const auto written = [&](std::span<const std::string_view> images) {
    return testing::load_glb(
        GlbTemplate(topology, uvs, options).encode(positions, normals, "m", {}, images).text());
  };
  EXPECT_FALSE(written({}).meshes[0].primitives[0].attributes.contains("TANGENT"));

  options.materials[0].normal_image = 0;
  options.images = {{"image/png", ".normal"}};
  const std::string png = encode_png(1, 1, 3, std::vector<std::uint8_t>{128, 128, 255});
  const std::string_view image = png;
  const tinygltf::Model model = written({&image, 1});
  // Each side has its own vertices at the edge.
  EXPECT_EQ(attribute(model, "_VERTEX_ID"), (std::vector<float>{0, 1, 2, 3, 4, 5, 1, 2}));
  const std::vector<float> tangents = attribute(model, "TANGENT");
  ASSERT_EQ(tangents.size(), 32U);
  for (std::size_t v = 0; v < 8; ++v) {
    const float side = v < 4 ? -1 : 1;  // u grows away from the edge
    EXPECT_EQ(std::vector<float>(tangents.begin() + static_cast<std::ptrdiff_t>(4 * v),
                                 tangents.begin() + static_cast<std::ptrdiff_t>(4 * v + 4)),
              (std::vector<float>{side, 0, 0, side}))
        << v;
  }
}

// Eyeballs of one material were blank.
TEST(GlbTemplate, LaysAnOverlayOverTheMaterialsThatWantIt) {
  SmallMesh mesh;
  mesh.options.materials[1] = {
      .name = "eye", .colour = {0.7F, 0.7F, 0.6F, 1}, .uses_overlay = true};
  const std::string png = encode_png(1, 1, 3, std::vector<std::uint8_t>{200, 100, 50});
  mesh.options.overlay.emplace(GlbOverlay{png, {}});
  for (std::uint16_t v = 0; v < 8; ++v) {
    mesh.options.overlay->uvs.push_back({v, static_cast<std::uint16_t>(65535 - v)});
  }
  const Positions positions = testing::random_positions(8, 1);
  const GlbTemplate form(mesh.topology, mesh.uvs, mesh.options);
  const tinygltf::Model model = testing::load_glb(
      form.encode(positions, vertex_normals(mesh.topology, positions), "m").text());
  const auto& primitives = model.meshes[0].primitives;
  EXPECT_FALSE(primitives[0].attributes.contains("TEXCOORD_1"));
  const int places = primitives[1].attributes.at("TEXCOORD_1");
  EXPECT_TRUE(model.accessors[static_cast<std::size_t>(places)].normalized);
  const auto found = numbers<std::uint16_t>(model, places);
  const auto vertices = attribute(model, "_VERTEX_ID");
  ASSERT_EQ(found.size(), 2 * vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    EXPECT_EQ(found[2 * i], vertices[i]);
    EXPECT_EQ(found[2 * i + 1], 65535 - vertices[i]);
  }
  const auto& eye = model.materials[static_cast<std::size_t>(primitives[1].material)];
  EXPECT_EQ(eye.pbrMetallicRoughness.baseColorTexture.texCoord, 1);
  EXPECT_EQ(eye.pbrMetallicRoughness.baseColorTexture.index, 0);
  EXPECT_EQ(eye.pbrMetallicRoughness.baseColorFactor, (std::vector<double>{1, 1, 1, 1}));
  ASSERT_EQ(model.images.size(), 1U);
  EXPECT_EQ(model.images[0].name, "iris");
  const auto& view = model.bufferViews[static_cast<std::size_t>(model.images[0].bufferView)];
  const auto& bytes = model.buffers[0].data;
  EXPECT_EQ(
      std::string(bytes.begin() + static_cast<std::ptrdiff_t>(view.byteOffset),
                  bytes.begin() + static_cast<std::ptrdiff_t>(view.byteOffset + view.byteLength)),
      png);
}

TEST(GlbTemplate, TellsTheBoundsOfWhatItHolds) {
  const SmallMesh mesh;
  const Positions positions = testing::random_positions(8, 5);
  const GlbTemplate form(mesh.topology, mesh.uvs, mesh.options);
  const tinygltf::Model model = testing::load_glb(
      form.encode(positions, vertex_normals(mesh.topology, positions), "m").text());
  const auto& accessor = model.accessors[static_cast<std::size_t>(
      model.meshes[0].primitives[0].attributes.at("POSITION"))];
  for (Index c = 0; c < 3; ++c) {
    const auto axis = static_cast<std::size_t>(c);
    EXPECT_EQ(accessor.minValues.at(axis), static_cast<float>(positions.col(c).minCoeff()));
    EXPECT_EQ(accessor.maxValues.at(axis), static_cast<float>(positions.col(c).maxCoeff()));
  }
}

TEST(GlbTemplate, TurnsHeadsUprightAndForward) {
  const Topology cube = testing::cube_topology();
  const Positions positions = testing::cube_positions();
  const auto turned = [&](const char* up, const char* front) {
    GlbOptions options;
    options.up = *parse_axis(up);
    options.front = *parse_axis(front);
    const tinygltf::Model model = testing::load_glb(
        GlbTemplate(cube, {}, options).encode(positions, positions / std::sqrt(3.0), "m").text());
    EXPECT_TRUE(model.nodes[0].scale.empty());
    EXPECT_TRUE(model.materials.empty());
    EXPECT_EQ(model.meshes[0].primitives.at(0).attributes.count("TEXCOORD_0"), 0U);
    const auto& q = model.nodes[0].rotation;
    return q.empty() ? Eigen::Quaterniond::Identity() : Eigen::Quaterniond(q[3], q[0], q[1], q[2]);
  };
  const auto axis = [](const char* name) {
    const Axis parsed = *parse_axis(name);
    return Eigen::Vector3d(parsed.sign * Eigen::Vector3d::Unit(parsed.index));
  };
  const char* const names[] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
  for (const char* up : names) {
    for (const char* front : names) {
      if (up[1] == front[1]) continue;
      const Eigen::Quaterniond q = turned(up, front);
      EXPECT_NEAR(q.norm(), 1, 1e-12);
      EXPECT_LT((q * axis(up) - Eigen::Vector3d::UnitY()).norm(), 1e-12) << up << front;
      EXPECT_LT((q * axis(front) - Eigen::Vector3d::UnitZ()).norm(), 1e-12) << up << front;
    }
  }
}

TEST(GlbTemplate, HasTheSameBytesForAnyNumberOfThreads) {
  Topology grid = testing::grid_topology(300, 200);  // several blocks
  grid.corner_uvs = grid.corner_vertices;
  for (std::size_t c = 0; c < 4000; c += 4) grid.corner_uvs[c] = 0;
  const TextureCoordinates uvs = testing::random_positions(grid.vertex_count, 3).leftCols<2>();
  const Positions positions = testing::random_positions(grid.vertex_count, 2);
  const Positions normals = vertex_normals(grid, positions);
  std::string first;
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    const GlbTemplate form(grid, uvs, {});
    const EncodedFile file = form.encode(positions, normals, "grid");
    if (first.empty()) first = file.text();
    EXPECT_TRUE(file.text() == first) << threads << " threads";
    EXPECT_GT(form.memory_bytes() + form.encoding_memory_bytes(), first.size() - 100);
  }
  // The container: its length, a JSON chunk, a binary chunk, both in fours.
  testing::BinaryReader file(first);
  EXPECT_EQ(file.next_text(4), "glTF");
  EXPECT_EQ(file.next<std::uint32_t>(), 2U);
  EXPECT_EQ(file.next<std::uint32_t>(), first.size());
  const auto json_size = file.next<std::uint32_t>();
  EXPECT_EQ(json_size % 4, 0U);
  EXPECT_EQ(file.next_text(4), "JSON");
  file.next_text(json_size);
  const auto binary_size = file.next<std::uint32_t>();
  EXPECT_EQ(binary_size, first.size() - file.position() - 4);
  EXPECT_EQ(binary_size % 4, 0U);
  EXPECT_EQ(file.next_text(4), std::string("BIN\0", 4));
}

TEST(GlbTemplate, RefusesWhatIsNotFiniteOrDoesNotFit) {
  const SmallMesh mesh;
  const GlbTemplate form(mesh.topology, mesh.uvs, mesh.options);
  Positions positions = testing::random_positions(8, 1);
  const Positions normals = vertex_normals(mesh.topology, positions);
  EXPECT_THROW(form.encode(positions, {}, "mob_3"), BrokenPrecondition);
  positions(3, 0) = std::numeric_limits<double>::quiet_NaN();
  testing::expect_error(ExitCode::kBadData, {"mob_3", "not finite"},
                        [&] { form.encode(positions, normals, "mob_3"); });
  testing::expect_error(ExitCode::kBadData, {"16777216"}, [] {
    GlbTemplate(testing::make_topology((1 << 24) + 1, {{0, 1, 2}}), {}, {});
  });
}

}  // namespace
}  // namespace crowdface
