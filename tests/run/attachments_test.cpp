// SPDX-License-Identifier: Apache-2.0
// Hair and glasses on the faces of a crowd.
#include <cmath>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/cast/hair_colour.h"
#include "crowdface/core/file.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/crowd/crowd_directory.h"
#include "crowdface/crowd/verify.h"
#include "crowdface/io/image.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/run/crowd_sheets.h"
#include "crowdface/run/face_encoders.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"

#include "support/crowd_files.h"
#include "support/expect_error.h"
#include "support/mesh_files.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

class AttachmentsOfACrowd : public ::testing::Test {
 protected:
  AttachmentsOfACrowd() : folder_(crowd()) {
    folder_.folder().write("wear/cap.obj", cap());
    folder_.folder().write("wear/cap.mtl",
                           "newmtl hair\nKd 1 1 1\nmap_Kd maps/hair.png\nmap_d maps/hair.png\n");
    folder_.folder().write("wear/maps/hair.png", "no picture");
    folder_.folder().write("wear/rod.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1.5\nf 1 2 3\n");
  }
  static SmallCrowd crowd() {
    SmallCrowd crowd;
    crowd.count = 6;
    crowd.levels = "basis";
    crowd.more =
        "\nattachments:\n"
        "  fitted_to: ann\n"
        "  items: [{name: cap, kind: hair, file: wear/cap.obj},\n"
        "          {name: rod, kind: glasses, file: wear/rod.obj, moves: rigid}]\n"
        "  none: {glasses: 0.5}\n"
        "recipes: [{id: herself, target: ann, regions: {all: {iterations: 0, extrapolation: 1}}}]";
    return crowd;
  }
  /// The head ann, a little off her skin.
  std::string cap() const {
    const ObjFile ann = read_obj(folder_.head("ann"));
    const Positions off = ann.positions + 0.1 * vertex_normals(ann.topology, ann.positions);
    std::string text = "mtllib cap.mtl\n";
    for (Index v = 0; v < off.rows(); ++v) {
      text += concat("v ", off(v, 0), ' ', off(v, 1), ' ', off(v, 2), '\n');
    }
    text += "usemtl hair\n";
    for (Index f = 0; f < ann.topology.face_count(); ++f) {
      text += 'f';
      for (const std::uint32_t v : ann.topology.face(f)) text += concat(' ', v + 1);
      text += '\n';
    }
    return text;
  }
  void run(const std::vector<std::string>& set = {}, Replace replace = Replace::kRefuse) {
    testing::run(folder_, set, replace);
  }
  fs::path mesh(const std::string& name) const { return folder_.out() / "meshes" / name; }
  auto faces_built() const {
    return testing::read_json(folder_.out() / "timings.json").at("faces");
  }

  SmallCrowdFolder folder_;
};

// Their files stayed when another format held them.
TEST_F(AttachmentsOfACrowd, LeaveNothingWhenTheFormatIsReplaced) {
  run({"output.meshes=[obj]"});
  ASSERT_TRUE(fs::exists(mesh("attachments/cap/cap.mtl")));
  folder_.folder().write("out/meshes/attachments/cap/maps/hair.png", "altered since");
  run({"output.meshes=[points]"}, Replace::kForce);
  std::vector<std::string> left;
  for (const auto& [name, bytes] : testing::crowd_files(folder_.out() / "meshes")) {
    if (!name.ends_with(".npy")) left.push_back(name);
  }
  EXPECT_THAT(left, ::testing::ElementsAre("attachments/cap/maps/hair.png"));
}

TEST_F(AttachmentsOfACrowd, LieBesideTheMeshesOfThoseWhoWearThem) {
  run();
  std::size_t with = 0, without = 0;
  for (const auto& line : testing::plan_lines(folder_.out())) {
    const std::string id = line.at("id");
    const std::vector<std::string> placed = line.at("attachments");
    EXPECT_THAT(placed, ::testing::Contains("cap"));
    EXPECT_TRUE(fs::exists(mesh(id + "+cap.obj")));
    const bool rod = placed.size() == 2;
    EXPECT_EQ(fs::exists(mesh(id + "+rod.obj")), rod);
    (rod ? with : without) += 1;
  }
  EXPECT_GT(with, 0U);
  EXPECT_GT(without, 0U);
  EXPECT_THAT(testing::read_text(folder_.out() / "crowd.csv"), HasSubstr(",attachments,hair\r\n"));
}

TEST_F(AttachmentsOfACrowd, StandOnTheHeadTheyWereFittedToAsTheyWere) {
  run();
  const ObjFile cap = read_obj(folder_ / "wear/cap.obj");
  const ObjFile own = read_obj(mesh("herself+cap.obj"));
  EXPECT_EQ(own.topology.corner_vertices, cap.topology.corner_vertices);
  EXPECT_LT((own.positions - cap.positions).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(AttachmentsOfACrowd, FindTheirMaterialsInAFolderOfTheirOwn) {
  run();
  EXPECT_THAT(testing::read_text(mesh("herself+cap.obj")),
              HasSubstr("mtllib attachments/cap/cap.mtl\n"));
  EXPECT_EQ(testing::read_text(mesh("attachments/cap/cap.mtl")),
            testing::read_text(folder_ / "wear/cap.mtl"));
  EXPECT_EQ(testing::read_text(mesh("attachments/cap/maps/hair.png")), "no picture");
}

TEST_F(AttachmentsOfACrowd, AreNodesBelowTheFaceInGlbFiles) {
  run({"output.meshes=[glb]"});
  EXPECT_FALSE(fs::exists(mesh("herself+cap.obj")));
  for (const auto& line : testing::plan_lines(folder_.out())) {
    const std::string id = line.at("id");
    const auto scene = testing::read_glb(mesh(id + ".glb")).scene;
    std::vector<std::string> below;
    for (const auto& child : scene.at("nodes").at(0).at("children")) {
      below.push_back(scene.at("nodes").at(child.get<std::size_t>()).at("name"));
    }
    EXPECT_EQ(below, line.at("attachments").get<std::vector<std::string>>()) << id;
    EXPECT_EQ(scene.at("materials").back().value("name", ""), below.back() == "cap" ? "hair" : "");
  }
}

TEST_F(AttachmentsOfACrowd, AreMeshesBesideTheFacesInUsdLayers) {
  folder_.folder().write("wear/maps/hair.png",
                         encode_png(2, 2, 4, std::vector<std::uint8_t>(std::size_t{4} * 4, 128)));
  run({"output.meshes=[usd]"});
  EXPECT_FALSE(fs::exists(mesh("herself+cap.obj")));
  EXPECT_TRUE(fs::exists(mesh("attachments/cap/maps/hair.png")));
  for (const auto& line : testing::plan_lines(folder_.out())) {
    const std::string id = line.at("id");
    const bool has_rod = line.at("attachments").size() == 2;
    const std::string text = testing::read_text(mesh(id + ".usda"));
    EXPECT_EQ(text.find("def Mesh \"rod\"") != text.npos, has_rod) << id;
    const std::string cap = text.substr(text.find("def Mesh \"cap\""));
    EXPECT_THAT(cap, HasSubstr(concat("rel material:binding = </", id, "/cap_materials/hair>")));
    EXPECT_THAT(cap, HasSubstr("inputs:file = @./attachments/cap/maps/hair.png@"));
    EXPECT_THAT(cap, HasSubstr(concat("float inputs:opacity.connect = </", id,
                                      "/cap_materials/hair/holes.outputs:a>")));
  }
}

TEST_F(AttachmentsOfACrowd, LieBesidePlyFilesAsObj) {
  run({"output.meshes=[ply, glb]", "shapes={neutral: heads/ann.obj, directory: heads}"});
  EXPECT_FALSE(fs::exists(mesh("herself+cap+bob.obj"))) << "nor has the face";
  EXPECT_TRUE(fs::exists(mesh("herself.ply")));
  EXPECT_TRUE(fs::exists(mesh("herself+cap.obj")));
  EXPECT_TRUE(fs::exists(mesh("attachments/cap/cap.mtl")));
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
}

TEST_F(AttachmentsOfACrowd, GoAlongWithExpressionsInFilesOfTheirOwn) {
  std::istringstream head(testing::read_text(folder_.head("ann")));
  std::string shape;
  for (std::string line; std::getline(head, line);) {
    std::istringstream words(line);
    std::string word;
    double x = 0, y = 0, z = 0;
    words >> word >> x >> y >> z;
    shape += word == "v" ? concat("v ", x + 0.5, ' ', y, ' ', z, '\n') : line + '\n';
  }
  folder_.folder().write("shapes/aside.obj", shape);
  run({"shapes={neutral: heads/ann.obj, directory: shapes}"});
  const Positions rest = read_obj(mesh("herself+cap.obj")).positions,
                  acting = read_obj(mesh("herself+cap+aside.obj")).positions;
  for (Index v = 0; v < rest.rows(); ++v) {
    EXPECT_NEAR(acting(v, 0) - rest(v, 0), 0.5, 1e-4) << v;
    EXPECT_NEAR(acting(v, 1), rest(v, 1), 1e-4) << v;
  }
  for (const auto& line : testing::plan_lines(folder_.out())) {
    const std::string id = line.at("id");
    EXPECT_TRUE(fs::exists(mesh(id + "+cap+aside.obj")));
    EXPECT_FALSE(fs::exists(mesh(id + "+rod+aside.obj"))) << "what is rigid stays";
  }
  EXPECT_THAT(testing::read_text(mesh("herself+cap+aside.obj")),
              HasSubstr("mtllib attachments/cap/cap.mtl\n"));
  fs::remove(mesh("herself+cap+aside.obj"));
  EXPECT_THAT(verify_crowd(folder_.out()).missing_files,
              ::testing::ElementsAre("meshes/herself+cap+aside.obj"));
  run({"shapes={neutral: heads/ann.obj, directory: shapes}"});
  EXPECT_EQ(faces_built(), 1);
}

TEST_F(AttachmentsOfACrowd, AreReducedOnLevelsOfDetailUnlessTheyAreSmall) {
  constexpr int kSide = 24;
  std::string veil = "mtllib cap.mtl\n";
  for (int i = 0; i < kSide * kSide; ++i) {
    const double x = (i % kSide - 11.5) / 12, y = (i / kSide - 11.5) / 12;
    veil += concat("v ", x, ' ', y, ' ', 1.4 + 0.1 * x * y, "\nvt ", (x + 1) / 2, ' ', (y + 1) / 2,
                   '\n');
  }
  veil += "usemtl hair\n";
  for (int i = 0; i < kSide * (kSide - 1); ++i) {
    if (i % kSide == kSide - 1) continue;
    veil += 'f';
    for (const int v : {i + 1, i + 2, i + kSide + 2, i + kSide + 1}) veil += concat(' ', v, '/', v);
    veil += '\n';
  }
  folder_.folder().write("wear/veil.obj", veil);
  const std::vector<std::string> set = {
      "attachments={fitted_to: ann, items: [{name: veil, kind: hair, file: wear/veil.obj}, "
      "{name: rod, kind: glasses, file: wear/rod.obj, moves: rigid}]}",
      "output.meshes=[obj, glb, usd]", "output.lods=[60 %, 10 %]"};
  run(set);
  const ObjFile whole = read_obj(mesh("herself+veil.obj"));
  const Index triangles = 2 * whole.topology.face_count();
  Index before = triangles;
  for (const std::string level : {"LOD1", "LOD2"}) {
    const ObjFile veiled = read_obj(mesh("herself+" + level + "+veil.obj"));
    EXPECT_LT(10 * veiled.topology.face_count(), 7 * before);
    before = veiled.topology.face_count();
    for (Index v = 0; v < veiled.positions.rows(); ++v) {
      EXPECT_EQ((whole.positions.rowwise() - veiled.positions.row(v)).rowwise().norm().minCoeff(),
                0)
          << "its vertices are the whole mesh's own";
    }
    EXPECT_THAT(testing::read_text(mesh("herself+" + level + "+veil.obj")),
                HasSubstr("mtllib attachments/veil/cap.mtl\n"));
    EXPECT_EQ(veiled.materials.at(0).name, "hair");
    EXPECT_EQ(read_obj(mesh("herself+" + level + "+rod.obj")).topology.face_count(), 1);
    const auto scene = testing::read_glb(mesh("herself+" + level + ".glb")).scene;
    std::vector<std::string> below;
    for (const auto& child : scene.at("nodes").at(0).at("children")) {
      below.push_back(scene.at("nodes").at(child.get<std::size_t>()).at("name"));
    }
    EXPECT_THAT(below, ::testing::ElementsAre("veil", "rod"));
    const auto& veil_mesh = scene.at("meshes").at(1).at("primitives").at(0);
    EXPECT_EQ(scene.at("accessors").at(veil_mesh.at("indices").get<std::size_t>()).at("count"),
              3 * veiled.topology.face_count());
    const std::string usd = testing::read_text(mesh("herself+" + level + ".usda"));
    EXPECT_THAT(usd, HasSubstr("def Mesh \"veil\""));
    EXPECT_THAT(usd, HasSubstr("def Mesh \"rod\""));
  }
  EXPECT_GT(before, 280) << "hardly fewer triangles than such a small mesh may have";
  EXPECT_TRUE(testing::read_json(folder_.out() / "report.json")
                  .at("faces")
                  .at(0)
                  .at("lods")
                  .contains("LOD1+veil.obj"));
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
  fs::remove(mesh("herself+LOD2+veil.obj"));
  EXPECT_THAT(verify_crowd(folder_.out()).missing_files,
              ::testing::ElementsAre("meshes/herself+LOD2+veil.obj"));
  run(set);
  EXPECT_EQ(faces_built(), 1);
}

TEST_F(AttachmentsOfACrowd, AreRecordedVerifiedResumedAndRemoved) {
  run();
  const auto whole = testing::crowd_files(folder_.out());
  fs::remove(mesh("herself+cap.obj"));
  fs::remove(mesh("attachments/cap/cap.mtl"));
  EXPECT_THAT(
      verify_crowd(folder_.out()).missing_files,
      ::testing::UnorderedElementsAre("meshes/attachments/cap/cap.mtl", "meshes/herself+cap.obj"));
  run();
  EXPECT_THAT(testing::differing_files(whole, testing::crowd_files(folder_.out())), IsEmpty());
  EXPECT_EQ(faces_built(), 1);
  folder_.folder().write("wear/cap.mtl", "newmtl hair\nKd 1 0 0\n");
  run();
  EXPECT_EQ(faces_built(), 7) << "other materials";
  run({"output.meshes=[]"}, Replace::kForce);
  EXPECT_FALSE(fs::exists(mesh("herself+cap.obj")));
}

// They were carried by unrounded positions, so that pictures made from meshes were others; and
// their movement under shapes was lost.
TEST_F(AttachmentsOfACrowd, LookTheSameInPicturesMadeFromMeshes) {
  for (const std::string_view file : kGalleryPageFiles) {
    folder_.folder().write(concat("page/", file), "a page");
  }
  ::setenv("CROWDFACE_GALLERY", (folder_ / "page").c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
  run({"output.contact_sheet={columns: 2, cell: 96}",
       "shapes={neutral: heads/ann.obj, directory: heads}"});
  const auto whole = testing::crowd_files(folder_.out());
  fs::remove_all(folder_.out() / "renders");
  fs::remove_all(folder_.out() / "gallery/data/faces");
  remake_sheets(folder_.out(), {}, folder_.cache());
  ::unsetenv("CROWDFACE_GALLERY");  // NOLINT(concurrency-mt-unsafe)
  EXPECT_TRUE(fs::exists(folder_.out() / "gallery/data/faces/herself.js"));
  EXPECT_THAT(testing::differing_files(whole, testing::crowd_files(folder_.out())), IsEmpty());
}

// GLB files did not count them.
TEST_F(AttachmentsOfACrowd, CountForTheMemoryThatFilesTake) {
  const Job with = load_job(folder_.config(), {}),
            without = load_job(folder_.config(), {{"attachments=none"}, {}, {}, {}});
  FacePlan face;
  face.attachments = {"cap"};
  for (const MeshFormat format : all_mesh_formats()) {
    const auto bytes = [&](const Job& job) {
      return FaceEncoders(job.config, job.inputs, {format}, {&face, 1}).encoding_memory_bytes();
    };
    const bool has_them = traits_of(format).attachments != DataStorage::kNowhere;
    const auto cap =
        static_cast<std::size_t>(with.inputs.attachments.at("cap").file.positions.rows());
    EXPECT_GE(bytes(with), bytes(without) + (has_them ? cap * 3 * sizeof(float) : 0))
        << name_of(format);
  }
}

TEST_F(AttachmentsOfACrowd, ChangeNothingElseOfAPlan) {
  run();
  const auto with = testing::plan_lines(folder_.out());
  run({"attachments=none"}, Replace::kForce);
  const auto without = testing::plan_lines(folder_.out());
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    auto line = with[i];
    EXPECT_EQ(line.erase("attachments"), 1U);
    EXPECT_EQ(line, without[i]);
  }
  EXPECT_THAT(testing::read_text(folder_.out() / "config.yaml"), Not(HasSubstr("attachments")));
}

TEST_F(AttachmentsOfACrowd, AreCountedInTheReport) {
  run({"attachments.none={}", "attachments.quotas={glasses: 0.5}"});
  const auto counted =
      testing::read_json(folder_.out() / "report.json").at("casting").at("attachments");
  std::size_t rods = 0, sampled = 0;
  for (const auto& line : testing::plan_lines(folder_.out())) {
    const std::vector<std::string> placed = line.at("attachments");
    const bool has_rod = std::find(placed.begin(), placed.end(), "rod") != placed.end();
    rods += has_rod ? 1 : 0;
    sampled += has_rod && !line.at("index").is_null() ? 1 : 0;
  }
  EXPECT_EQ(sampled, 3U) << "half of six";
  EXPECT_EQ(counted.at("quotas").at("glasses").at("faces"), 3);
  EXPECT_EQ(counted.at("kinds").at("glasses").at("items").at("rod"), rods);
  EXPECT_EQ(counted.at("kinds").at("hair").at("faces"), 7);
}

// A cut exists once; every face has its own colour, and faces of equal colour share the files.
TEST_F(AttachmentsOfACrowd, HaveTheHairColourOfEachFace) {
  const std::vector<std::uint8_t> neutral(4 * 4 * 4, 170);
  folder_.folder().write("wear/maps/hair.png", encode_png(4, 4, 4, neutral));
  run({"attachments.items=[{name: cap, kind: hair, file: wear/cap.obj, tint: hair}]",
       "attachments.none={}", "attachments.hair_colours={red: 0.5, black: 0.5}",
       "output.meshes=[obj, glb, usd]"});
  std::set<std::string> labels;
  for (const auto& line : testing::plan_lines(folder_.out())) {
    const std::string id = line.at("id");
    const auto& hair = line.at("hair");
    const HairColour colour{hair.at("eumelanin"), hair.at("pheomelanin"), hair.at("grey")};
    const std::string label = colour_label(colour);
    labels.insert(label);
    const std::string folder = concat("attachments/cap/", label, '/');
    EXPECT_THAT(read_file(mesh(id + "+cap.obj")),
                HasSubstr(concat("mtllib ", folder, "cap.mtl\n")));
    EXPECT_THAT(read_file(mesh(id + ".usda")),
                HasSubstr(concat('@', "./", folder, "maps/hair.png@")));
    const Image image = read_image(mesh(folder + "maps/hair.png"));
    const auto factors = tint_factors(colour);
    const auto scene = testing::read_glb(mesh(id + ".glb")).scene;
    const auto& factor =
        scene.at("materials").back().at("pbrMetallicRoughness").at("baseColorFactor");
    EXPECT_NEAR(factor.at(0).get<double>(), factors[0], 1e-4) << id;
    for (int c = 0; c < 3; ++c) {
      const float light = kNeutralTextureMean * factors[static_cast<std::size_t>(c)];
      const float srgb =
          light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1 / 2.4F) - 0.055F;
      EXPECT_NEAR(image.at(0, 0, c), srgb, 0.01) << id;
    }
    EXPECT_NEAR(image.at(0, 0, 3), 170 / 255.0, 1e-3);
  }
  EXPECT_GE(labels.size(), 2U);
  EXPECT_TRUE(fs::exists(mesh("attachments/cap")));
  EXPECT_FALSE(fs::exists(mesh("attachments/cap/cap.mtl"))) << "the neutral files are not copied";
  EXPECT_TRUE(verify_crowd(folder_.out()).is_intact());
}

TEST_F(AttachmentsOfACrowd, AreTheSameInALargerCrowdAndWithAnyThreads) {
  run();
  const auto small = testing::crowd_files(folder_.out() / "meshes");
  const ThreadLimit limit(1);
  run({"crowd.count=9"}, Replace::kForce);
  const auto large = testing::crowd_files(folder_.out() / "meshes");
  for (const auto& [name, bytes] : small) EXPECT_EQ(large.at(name), bytes) << name;
}

TEST_F(AttachmentsOfACrowd, AreRefusedWhereTheyAreNoHeads) {
  folder_.folder().write("wear/rod.obj", "v 0 0 900\nv 1 0 900\nv 0 1 900\nf 1 2 3\n");
  testing::expect_error(ExitCode::kBadData, {"rod.obj", "in the place and unit of the head"},
                        [&] { run(); });
  fs::remove(folder_ / "wear/rod.obj");
  testing::expect_error(ExitCode::kMissingInput, {"rod.obj", "is missing"}, [&] { run(); });
}

}  // namespace
}  // namespace crowdface
