// SPDX-License-Identifier: Apache-2.0
// One face in several formats.
#include <gtest/gtest.h>

#include "crowdface/core/hash.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/material_files.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/io/read_mesh.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/mesh_files.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

std::string meshes_in(MeshFormat format) {
  return concat("output.meshes=[", name_of(format), "]");
}

const std::string kAll = [] {
  std::vector<std::string> words;
  for (const MeshFormat format : all_mesh_formats()) words.emplace_back(name_of(format));
  return concat("output.meshes=[", join(words), "]");
}();

testing::Singles to_singles(const reference::Points& points) {
  testing::Singles singles;
  for (const auto& [x, y, z] : points) {
    singles.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  }
  return singles;
}

/// Expects the files of one face to hold the positions of its OBJ file, and the shape of it.
void expect_same_face(const fs::path& meshes, const std::string& id) {
  const reference::Obj obj = reference::read_obj(meshes / (id + ".obj"));
  const testing::Singles points = to_singles(obj.vertices);
  const testing::PlyFile ply = testing::read_ply(meshes / (id + ".ply"));
  EXPECT_EQ(ply.points, points);
  EXPECT_EQ(ply.faces, obj.faces);

  std::string dictionary;
  const auto numbers = testing::read_npy_numbers<float>(meshes / (id + ".npy"), dictionary);
  EXPECT_TRUE(dictionary.starts_with(
      concat("{'descr': '<f4', 'fortran_order': False, 'shape': (", points.size(), ", 3), }")));
  ASSERT_EQ(numbers.size(), 3 * points.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], points[i / 3][i % 3]);

  const testing::GlbFile glb = testing::read_glb(meshes / (id + ".glb"));
  ASSERT_GE(glb.points.size(), points.size());
  ASSERT_EQ(glb.points.size(), glb.ids.size());
  for (std::size_t i = 0; i < glb.points.size(); ++i) {
    if (i < points.size()) {
      EXPECT_EQ(glb.ids[i], static_cast<float>(i));
    }
    EXPECT_EQ(glb.points[i], points.at(static_cast<std::size_t>(glb.ids[i]))) << i;
  }
  EXPECT_EQ(glb.scene.at("nodes").at(0).at("name"), id);
  std::size_t triangles = 0;
  for (const auto& face : obj.faces) triangles += face.size() - 2;
  EXPECT_EQ(glb.corners.size(), 3 * triangles);
}

TEST(MeshFormats, HoldTheSameFace) {
  for (const bool normals : {false, true}) {
    SmallCrowd crowd;
    crowd.bowl.normals = normals;
    crowd.bowl.materials = true;
    crowd.count = 2;
    const SmallCrowdFolder folder(crowd);
    run(folder, {kAll});
    const auto report = testing::read_json(folder.out() / "report.json");
    for (const auto& face : report.at("faces")) {
      const auto id = face.at("id").get<std::string>();
      SCOPED_TRACE(id);
      expect_same_face(folder.out() / "meshes", id);
      const fs::path stem = folder.out() / "meshes" / id;
      const auto digest = [&](const char* extension) {
        return hash_bytes(testing::read_text(stem.string() + extension)).hex();
      };
      EXPECT_EQ(face.at("mesh"), digest(".obj"));
      for (const MeshFormat format : all_mesh_formats()) {
        EXPECT_EQ(face.at(std::string(traits_of(format).report_key)),
                  digest(std::string(extension_of(format)).c_str()))
            << name_of(format);
      }
      const testing::PlyFile ply = testing::read_ply(stem.string() + ".ply");
      EXPECT_EQ(ply.normals.empty(), !normals) << "only where the input has them";
      const testing::GlbFile glb = testing::read_glb(stem.string() + ".glb");
      EXPECT_EQ(glb.normals.size(), glb.points.size());
      if (normals) {
        for (std::size_t i = 0; i < ply.normals.size(); ++i) {
          EXPECT_EQ(ply.normals[i], glb.normals[i]);
        }
      }
    }
  }
}

TEST(MeshFormats, HaveTheFacesColoursAtVertices) {
  SmallCrowd crowd;
  crowd.count = 2;
  crowd.contact_sheet = "{cell: 32}";
  const SmallCrowdFolder folder(crowd);
  const int tones[] = {204, 204, 51, 51};
  for (std::size_t h = 0; h < folder.names().size(); ++h) {
    const fs::path head = folder.head(folder.names()[h]);
    const std::string text = testing::read_text(head);
    const ColourRows colours = ColourRows::Constant(read_obj(head).positions.rows(), 3,
                                                    static_cast<std::uint8_t>(tones[h]));
    folder.folder().write("heads/" + head.filename().string(), with_colours(text, colours));
  }
  run(folder, {kAll, "output.lods=[50 %]"});
  const fs::path stem = folder.out() / "meshes" / "mob_0001";
  const std::string obj = testing::read_text(stem.string() + ".obj");
  const Index vertices = read_obj(stem.string() + ".obj").positions.rows();
  const ColourRows written = obj_colours(obj, vertices);
  ASSERT_EQ(written.rows(), vertices);
  EXPECT_GE(written.minCoeff(), 51);
  EXPECT_LE(written.maxCoeff(), 204);
  for (const char* ending : {".ply", ".glb"}) {
    FileMesh mesh = read_mesh(stem.string() + ending);
    join_split_vertices(mesh);
    ASSERT_EQ(mesh.colours.rows(), vertices) << ending;
    EXPECT_LT((mesh.colours - colour_fractions(written)).cwiseAbs().maxCoeff(), 0.002) << ending;
  }
  EXPECT_NE(testing::read_text(stem.string() + ".usda").find("primvars:displayColor = [("),
            std::string::npos);
  const std::string level = testing::read_text(stem.string() + "+LOD1.obj");
  const Index kept = read_obj(stem.string() + "+LOD1.obj").positions.rows();
  EXPECT_LT(kept, vertices);
  EXPECT_EQ(obj_colours(level, kept).rows(), kept);
  const fs::path shown = folder.out() / "gallery/data/faces/mob_0001.js";
  if (!fs::exists(shown)) GTEST_SKIP() << "the page of the gallery was not built";
  EXPECT_NE(testing::read_text(shown).find("\"colours\":\""), std::string::npos);
}

TEST(MeshFormats, GlbCornersHaveTheTextureCoordinatesOfTheObj) {
  SmallCrowd crowd;
  crowd.count = 1;
  const SmallCrowdFolder folder(crowd);
  run(folder, {kAll});
  const fs::path meshes = folder.out() / "meshes";
  const reference::Obj obj = reference::read_obj(meshes / "mob_0001.obj");
  const testing::GlbFile glb = testing::read_glb(meshes / "mob_0001.glb");
  EXPECT_GT(glb.ids.size(), obj.vertices.size()) << "the bowl has a seam";
  std::size_t at = 0;
  for (std::size_t f = 0; f < obj.faces.size(); ++f) {
    for (std::size_t k = 1; k + 1 < obj.faces[f].size(); ++k) {
      for (const std::size_t corner : {std::size_t{0}, k, k + 1}) {
        const std::uint32_t split = glb.corners.at(at++);
        EXPECT_EQ(glb.ids[split], static_cast<float>(obj.faces[f][corner]));
        const auto uv = obj.face_uvs[f][corner];
        ASSERT_TRUE(uv);
        EXPECT_EQ(glb.uvs[split][0], static_cast<float>(obj.uvs[*uv][0]));
        EXPECT_EQ(glb.uvs[split][1], static_cast<float>(1 - obj.uvs[*uv][1]));
      }
    }
  }
}

// Eyeballs of one material were blank where no texture showed their irises.
TEST(MeshFormats, GlbEyesHaveAnIrisUnlessAColourIsGiven) {
  SmallCrowd crowd;
  crowd.bowl.materials = true;
  crowd.count = 1;
  const SmallCrowdFolder folder(crowd);
  const auto textured = [&](const std::string& out, std::vector<std::string> set) {
    set.emplace_back("output.meshes=[glb]");
    run_to(folder, out, {std::move(set), {}, {}, {}});
    const auto scene = testing::read_glb(folder / out / "meshes/mob_0001.glb").scene;
    std::vector<std::string> names;
    for (const auto& material : scene.at("materials")) {
      const auto& look = material.at("pbrMetallicRoughness");
      if (!look.contains("baseColorTexture")) continue;
      EXPECT_EQ(look.at("baseColorTexture").at("texCoord"), 1);
      names.push_back(material.at("name"));
    }
    EXPECT_EQ(scene.contains("images"), !names.empty());
    return names;
  };
  EXPECT_EQ(textured("iris", {}), std::vector<std::string>{"eye"});
  EXPECT_EQ(textured("green", {"output.surfaces={eye: \"#20a040\"}"}), std::vector<std::string>{});
}

TEST(MeshFormats, UsdFindsTheIrisOfItsEyesOnceBeside) {
  SmallCrowd crowd;
  crowd.bowl.materials = true;
  const SmallCrowdFolder folder(crowd);
  run(folder, {"output.meshes=[usd]"});
  const fs::path iris = folder.out() / "meshes/topology/iris.png";
  EXPECT_THAT(testing::read_text(folder.out() / "meshes/mob_0001.usda"),
              ::testing::HasSubstr("@./topology/iris.png@"));
  const std::string picture = testing::read_text(iris);
  EXPECT_TRUE(picture.starts_with("\x89PNG"));
  fs::remove(iris);
  run(folder, {"output.meshes=[usd]"});
  EXPECT_EQ(testing::read_text(iris), picture);
  run_to(folder, "green",
         {{"output.meshes=[usd]", "output.surfaces={eye: \"#20a040\"}"}, {}, {}, {}});
  EXPECT_FALSE(fs::exists(folder / "green/meshes/topology"));
}

TEST(MeshFormats, PointsHaveTheirTopologyOnceBeside) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder, {"output.meshes=[points]"});
  const fs::path arrays = folder.out() / "meshes/topology";
  std::string dictionary;
  const auto corners = testing::read_npy_numbers<std::int32_t>(arrays / "corners.npy", dictionary);
  const auto offsets = testing::read_npy_numbers<std::int32_t>(arrays / "offsets.npy", dictionary);
  const reference::Obj head = reference::read_obj(folder.head("ann"));
  ASSERT_EQ(offsets.size(), head.faces.size() + 1);
  for (std::size_t f = 0; f < head.faces.size(); ++f) {
    const std::vector<std::size_t> face(corners.begin() + offsets[f],
                                        corners.begin() + offsets[f + 1]);
    EXPECT_EQ(face, head.faces[f]);
  }
  EXPECT_TRUE(fs::exists(arrays / "uvs.npy"));
  EXPECT_TRUE(fs::exists(arrays / "corner_uvs.npy"));
  EXPECT_FALSE(fs::exists(folder.out() / "meshes/mob_0001.obj"));
}

// A head could name a face's own file as its texture, which was then copied over the face.
TEST(MeshFormats, HaveNamesThatNoTextureMayHave) {
  const testing::TemporaryFolder folder;
  for (const MeshFormat format : all_mesh_formats()) {
    const std::string name = concat("face_0001", extension_of(format));
    folder.write(name, "x");
    folder.write("a.mtl", concat("map_Kd ", name, "\n"));
    EXPECT_EQ(find_material_files(folder / "head.obj", {"a.mtl"}).files.size(), 1U) << name;
  }
}

TEST(MeshFormats, HaveTheSameBytesForAnyNumberOfThreads) {
  SmallCrowd crowd;
  crowd.bowl.normals = true;
  crowd.bowl.columns = 110;  // several blocks of lines
  crowd.bowl.rows = 100;
  const SmallCrowdFolder folder(crowd);
  {
    const ThreadLimit limit(1);
    run(folder, {kAll});
  }
  const auto first = testing::crowd_files(folder.out());
  fs::remove_all(folder.out());
  const ThreadLimit limit(5);
  run(folder, {kAll});
  EXPECT_THAT(testing::differing_files(first, testing::crowd_files(folder.out())),
              ::testing::IsEmpty());
}

TEST(MeshFormats, OfAnOldCrowdAreAllRemoved) {
  const SmallCrowdFolder folder(SmallCrowd{});
  run(folder, {kAll});
  run(folder, {"output.meshes=[]"}, Replace::kForce);
  for (const auto& [name, bytes] : testing::crowd_files(folder.out())) {
    EXPECT_FALSE(name.starts_with("meshes/")) << name;
  }
  EXPECT_FALSE(fs::exists(folder.out() / "meshes"));
}

TEST(MeshFormats, GiveTheSameSheetsAgain) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 2, rows: 2, cell: 32}";
  const SmallCrowdFolder folder(crowd);
  std::string expected;
  for (const MeshFormat format : all_mesh_formats()) {
    if (traits_of(format).read == nullptr) continue;
    const std::string out(name_of(format));
    run_to(folder, out, {{meshes_in(format)}, {}, {}, {}});
    fs::remove_all(folder / concat(out, "/renders"));
    remake_sheets(folder / out, {});
    const std::string sheet = testing::read_text(folder / concat(out, "/sheets/sheet_001.png"));
    if (expected.empty()) expected = sheet;
    EXPECT_TRUE(sheet == expected) << out;
  }
  run_to(folder, "none", {{"output.meshes=[]"}, {}, {}, {}});
  remake_sheets(folder / "none", {});
  EXPECT_TRUE(testing::read_text(folder / "none/sheets/sheet_001.png") == expected);
  fs::remove_all(folder / "none/renders");
  testing::expect_error(ExitCode::kMissingInput, {"no meshes"},
                        [&] { remake_sheets(folder / "none", {}); });
}

TEST(MeshFormats, RefuseFilesThatAreNotTheCrowds) {
  SmallCrowd crowd;
  crowd.contact_sheet = "{columns: 2, rows: 2, cell: 32}";
  const SmallCrowdFolder folder(crowd);
  run(folder, {kAll});
  for (const MeshFormat format : all_mesh_formats()) {
    // Any OBJ file of as many vertices is taken.
    if (format == MeshFormat::kObj || traits_of(format).read == nullptr) continue;
    const std::string out(name_of(format));
    run_to(folder, out, {{meshes_in(format)}, {}, {}, {}});
    const std::string name = concat(out, "/meshes/mob_0002", extension_of(format));
    const std::string good = testing::read_text(folder / name);
    for (const std::string& bad :
         {std::string(), good.substr(0, 20), good.substr(0, good.size() / 8), "x" + good}) {
      folder.folder().write(name, bad);
      testing::expect_error(ExitCode::kBadData, {"mob_0002", "expected"},
                            [&] { remake_sheets(folder / out, {}); });
    }
  }
}

TEST(MeshFormats, NameTheFileThatCannotBeWritten) {
  const SmallCrowdFolder folder(SmallCrowd{});
  for (const MeshFormat format : all_mesh_formats()) {
    const std::string out(name_of(format));
    const std::string name = concat(out, "/meshes/mob_0002", extension_of(format));
    const ConfigOverrides overrides = {{meshes_in(format)}, {}, {}, {}};
    run_to(folder, out, overrides);
    fs::remove(folder / name);
    folder.folder().write(name + "/in_the_way", "a folder has the name");
    testing::expect_error(ExitCode::kCannotCreate, {name}, [&] { run_to(folder, out, overrides); });
  }
}

TEST(MeshFormats, HoldRealHeads) {
  const fs::path heads = fs::path(CROWDFACE_SOURCE_DIR) / "../shared/faces/ict16";
  if (!fs::exists(heads / "ict_00.obj")) {
    GTEST_SKIP() << "no real heads at " << heads << ": put OBJ files ict_00.obj … there";
  }
  const testing::TemporaryFolder folder;
  const fs::path config = folder.write(
      "config.yaml", concat("schema: 1\ncrowd: {name: real, count: 2, seed: 5}\nfaces: {files: [",
                            (heads / "ict_03.obj").string(), ", ", (heads / "ict_07.obj").string(),
                            "], units: cm}\noutput: {directory: out, contact_sheet: none,\n"
                            "         meshes: [obj, ply, glb, points]}\n"));
  generate(config, {}, {folder / "cache", Replace::kRefuse, false});
  for (const char* id : {"real_0001", "real_0002"}) expect_same_face(folder / "out/meshes", id);
}

}  // namespace
}  // namespace crowdface
