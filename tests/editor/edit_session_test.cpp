// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/edit_session.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/editor/recipe_json.h"
#include "crowdface/editor/region_painting.h"
#include "crowdface/heads/named_parts.h"
#include "crowdface/io/image.h"
#include "crowdface/io/obj_writer.h"
#include "head_models/synth/synthetic_head.h"

#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

using Json = nlohmann::ordered_json;

/// A BinaryAnswer as a page reads it.
struct Read {
  Json head;
  std::map<std::string, std::vector<double>> arrays;
};

template <class T>
std::vector<double> numbers(const char* at, std::size_t count) {
  std::vector<T> values(count);
  std::memcpy(values.data(), at, count * sizeof(T));
  return {values.begin(), values.end()};
}

Read read_answer(const std::string& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data(), sizeof(length));
  EXPECT_EQ(length % 4, 0U);
  Read read{Json::parse(bytes.substr(4, length)), {}};
  std::size_t at = 4 + length;
  for (const Json& array : read.head["arrays"]) {
    const std::string type = array["type"];
    const std::size_t count = array["count"];
    std::size_t width = 4;
    auto& values = read.arrays[array["name"]];
    if (type == "f32") values = numbers<float>(bytes.data() + at, count);
    if (type == "u32") values = numbers<std::uint32_t>(bytes.data() + at, count);
    if (type == "i16") values = numbers<std::int16_t>(bytes.data() + at, count), width = 2;
    if (type == "u8") values = numbers<std::uint8_t>(bytes.data() + at, count), width = 1;
    at += (count * width + 3) / 4 * 4;
  }
  EXPECT_EQ(at, bytes.size());
  return read;
}

/// Four synthetic heads with eyes and teeth, three regions, and an editor of them. Lips are not
/// brought to their gaps, which the page leaves to the program.
struct Editor {
  /// \param more  sections of the config
  explicit Editor(const std::string& levels, std::size_t preview_vertices = 100'000,
                  const std::string& more = "") {
    const SyntheticHeads synthetic(6000, SyntheticHeads::Parts::kEyesAndTeeth);
    for (Index h = 0; h < 4; ++h) {
      Mesh mesh{synthetic.topology(), synthetic.positions(3, static_cast<std::uint64_t>(h)),
                synthetic.uvs()};
      std::filesystem::create_directories(folder / "heads");
      encode_obj(mesh, "").write(folder / concat("heads/head_", h, ".obj"));
    }
    folder.write("mask.png", encode_png(64, 64, 3, synthetic_region_mask(64)));
    folder.write("config.yaml", concat("schema: 1\n"
                                       "crowd: {name: face, count: 3}\n"
                                       "faces: {directory: heads, units: cm}\n"
                                       "regions: {names: [top, middle, bottom], mask: mask.png}\n"
                                       "blending: {contacts: none}\n"
                                       "smoothing: {levels: ",
                                       levels, "}\noutput: {directory: out}\n", more));
    session.emplace(load_job(folder / "config.yaml", {}), folder / "cache", preview_vertices);
  }
  FacePlan face(const Json& recipe) const {
    return face_of_json(recipe, session->casting(), session->job().config);
  }
  std::filesystem::path strokes() const { return folder / "strokes.jsonl"; }
  testing::TemporaryFolder folder;
  std::optional<EditSession> session;
};

Json some_recipe() {
  return Json::parse(R"({"id": "edited", "target": "head_1", "regions": {
    "top": {"position": [0.3, -0.2], "smoothness": 0.3, "extrapolation": 1.2},
    "middle": {"weights": {"head_0": 0.5, "head_2": 0.5}, "smoothness": "30 mm", "extrapolation": 1},
    "bottom": {"position": [-0.4, 0.1], "iterations": 40, "extrapolation": 0.9}}})");
}

/// The face as the page computes it (in single precision, from what the page gets) against the
/// engine's. \return the largest difference over the preview's skin in mm.
double preview_error_mm(const Editor& editor, const FacePlan& face) {
  const EditSession& session = *editor.session;
  const Read mesh = read_answer(session.mesh_answer());
  const auto vertices = static_cast<std::size_t>(mesh.head["vertices"]);
  const std::size_t regions = face.recipe.regions.size();
  std::vector<Read> heads;
  for (Index h = 0; h < 4; ++h) heads.push_back(read_answer(session.head_answer(h)));
  const auto target = static_cast<std::size_t>(face.recipe.target);
  std::vector<double> points = heads[target].arrays["positions"];
  for (std::size_t k = 0; k < regions; ++k) {
    const RegionRecipe& region = face.recipe.regions[k];
    std::vector<double> shares(4, 0.0);
    shares[target] = 1;
    for (const SourceWeight& source : region.weights) {
      shares[static_cast<std::size_t>(source.head)] -= region.extrapolation * source.weight;
    }
    const double step =
        256 * std::sqrt(static_cast<double>(region.iterations) /
                        static_cast<double>(session.casting().level_scale.max_level));
    const auto below = std::min<std::size_t>(static_cast<std::size_t>(step), 255);
    const double part = step - static_cast<double>(below);
    for (std::size_t h = 0; h < 4; ++h) {
      const std::size_t rank = heads[h].head["rank"];
      const std::vector<double>& functions = heads[h].arrays["functions"];
      for (std::size_t p = 0; p < rank; ++p) {
        const double value =
            (1 - part) * functions[below * rank + p] + part * functions[(below + 1) * rank + p];
        const double factor = shares[h] * value * static_cast<double>(heads[h].head["scale"][p]);
        for (std::size_t i = 0; i < 3 * vertices; ++i) {
          points[i] += mesh.arrays.at("alpha")[i / 3 * regions + k] * factor *
                       heads[h].arrays["fields"][p * 3 * vertices + i];
        }
      }
    }
  }
  const std::vector<float> exact = session.preview_points(session.build(face.recipe));
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (mesh.arrays.at("part")[i / 3] != 0) continue;
    largest = std::max(largest, std::abs(points[i] - static_cast<double>(exact[i])));
  }
  return largest * 10;
}

TEST(EditSession, ThePagesFormulaGivesTheEnginesSkin) {
  const Editor editor("basis");
  EXPECT_LT(preview_error_mm(editor, editor.face(some_recipe())), 0.1);
}

TEST(EditSession, ExactLevelsArePreviewedByFields) {
  const Editor editor("exact");
  EXPECT_LT(preview_error_mm(editor, editor.face(some_recipe())), 0.1);
}

TEST(EditSession, AReducedPreviewConsistsOfTheMeshesOwnVertices) {
  const Editor editor("basis", 500);
  const PreviewMesh& preview = editor.session->preview();
  EXPECT_LT(preview.vertices.size(), 1500U);
  EXPECT_LT(preview_error_mm(editor, editor.face(some_recipe())), 0.1);
  const Positions face = editor.session->build(editor.face(some_recipe()).recipe);
  const std::vector<float> normals = editor.session->preview_normals(face);
  const Positions expected = vertex_normals(editor.session->job().inputs.head_set.topology, face);
  for (std::size_t i = 0; i < preview.vertices.size(); ++i) {
    EXPECT_EQ(preview.vertices[i], preview.vertices[preview.first_copy_of_vertex[i]]);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(static_cast<double>(normals[3 * i + static_cast<std::size_t>(c)]),
                  expected(preview.vertices[i], c), 1e-6);
    }
  }
}

TEST(EditSession, TextureCoordinatesAreThoseOfTheMesh) {
  const Editor editor("basis");
  const PreviewMesh& preview = editor.session->preview();
  const HeadSet& head_set = editor.session->job().inputs.head_set;
  std::map<std::uint32_t, std::vector<std::array<float, 2>>> known;
  for (std::size_t c = 0; c < head_set.topology.corner_uvs.size(); ++c) {
    const std::uint32_t row = head_set.topology.corner_uvs[c];
    known[head_set.topology.corner_vertices[c]].push_back(
        {static_cast<float>(head_set.uvs(row, 0)), static_cast<float>(head_set.uvs(row, 1))});
  }
  std::size_t split = 0;
  for (std::size_t i = 0; i < preview.vertices.size(); ++i) {
    const std::array<float, 2> uv = {preview.uvs[2 * i], preview.uvs[2 * i + 1]};
    EXPECT_THAT(known[preview.vertices[i]], ::testing::Contains(uv));
    if (preview.first_copy_of_vertex[i] != i) ++split;
  }
  EXPECT_GT(split, 0U);  // the unwrapped head has a seam
}

TEST(EditSession, ARecipeGoesThroughItsJsonUnchanged) {
  const Editor editor("basis");
  const FacePlan face = editor.face(some_recipe());
  const Json json = recipe_to_json(face, editor.session->casting(), editor.session->job().config);
  const FacePlan again = editor.face(json);
  ASSERT_EQ(again.recipe.regions.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(again.recipe.regions[k].weights, face.recipe.regions[k].weights);
    EXPECT_EQ(again.recipe.regions[k].iterations, face.recipe.regions[k].iterations);
    EXPECT_EQ(again.recipe.regions[k].extrapolation, face.recipe.regions[k].extrapolation);
  }
  EXPECT_EQ(editor.session->build(again.recipe), editor.session->build(face.recipe));
}

TEST(EditSession, AMixtureOfTargetsGoesThrough) {
  const Editor editor("basis");
  Json json = some_recipe();
  json["mixture"] = {{"head_1", 0.75}, {"head_3", 0.25}};
  const FacePlan face = editor.face(json);
  EXPECT_EQ(face.recipe.target, 1);
  EXPECT_EQ(face.recipe.mixture, (std::vector<SourceWeight>{{1, 0.75}, {3, 0.25}}));
  EXPECT_EQ(
      recipe_to_json(face, editor.session->casting(), editor.session->job().config)["mixture"],
      json["mixture"]);
  json["mixture"] = {{"nobody", 1}};
  testing::expect_error(ExitCode::kUsage, {"no head is called", "nobody"},
                        [&] { editor.face(json); });
}

TEST(EditSession, MistakesInARecipeAreTheConfigsOwn) {
  const Editor editor("basis");
  Json json = some_recipe();
  json["targte"] = "head_1";
  json["regions"]["top"]["smoothness"] = "five";
  testing::expect_error(
      ExitCode::kUsage,
      {"unknown key \"targte\"; did you mean \"target\"?", "regions.top.smoothness"},
      [&] { editor.face(json); });
}

TEST(EditSession, MeasuresAHeadAsItself) {
  const Editor editor("basis");
  Json json = some_recipe();
  for (auto& [name, region] : json["regions"].items()) {
    region = {{"weights", {{"head_1", 1}}}, {"smoothness", 0.5}, {"extrapolation", 1}};
  }
  const FacePlan head = editor.face(json);
  const FaceMeasures measures = editor.session->measure(head, editor.session->build(head.recipe));
  EXPECT_EQ(measures.nearest_head, 1);
  EXPECT_LT(measures.nearest_head_distance_mm, 0.01);
  EXPECT_THAT(measures.warnings, ::testing::IsEmpty());
  json["regions"]["top"] = {
      {"weights", {{"head_0", 1}}}, {"smoothness", 0.9}, {"extrapolation", 4}};
  const FacePlan wild = editor.face(json);
  const FaceMeasures whole = editor.session->measure(wild, editor.session->build(wild.recipe));
  EXPECT_THAT(whole.warnings, ::testing::Contains(::testing::HasSubstr("than the limit, ")));
  const FaceMeasures without_mesh = editor.session->measure(wild);
  EXPECT_EQ(without_mesh.nearest_head_distance_mm, whole.nearest_head_distance_mm);
  EXPECT_THAT(without_mesh.warnings, ::testing::Contains(::testing::HasSubstr("than the limit, ")));
}

TEST(EditSession, TellsFaultsOfTheWholeMesh) {
  const Editor editor("basis");
  Json json = some_recipe();
  for (auto& [name, region] : json["regions"].items()) {
    region = {{"weights", {{"head_1", 1}}}, {"smoothness", 0.5}, {"extrapolation", 1}};
  }
  const Recipe head = editor.face(json).recipe;
  const Positions plain = editor.session->build(head);
  EXPECT_THAT(editor.session->mesh_faults(head, plain), ::testing::IsEmpty());

  // Teeth that come forward through the lips.
  const Inputs& inputs = editor.session->job().inputs;
  Positions pushed = plain;
  for (const Part& part : inputs.parts.parts) {
    if (part.is_eyeball) continue;
    for (const std::uint32_t v : part.vertices) pushed(v, 2) += 1.5;
  }
  EXPECT_THAT(editor.session->mesh_faults(head, pushed),
              ::testing::ElementsAre("gums, teeth or other parts stand out of the skin"));

  // Skin whose upper half is turned inside out.
  Positions crossed = plain;
  for (const std::uint32_t v : skin_vertices(inputs)) {
    if (plain(v, 1) > 0) crossed(v, 2) = -plain(v, 2);
  }
  EXPECT_THAT(editor.session->mesh_faults(head, crossed),
              ::testing::Contains(::testing::HasSubstr("turned over")));
}

TEST(EditSession, DrawsAnewButForWhatIsLocked) {
  const Editor editor("basis");
  SampleRequest request{editor.face(some_recipe()), {1}, std::nullopt};
  request.count = 3;
  const std::vector<FacePlan> faces = editor.session->sample_faces(request);
  ASSERT_EQ(faces.size(), 3U);
  for (const FacePlan& face : faces) {
    EXPECT_EQ(face.id, "edited");
    EXPECT_EQ(face.recipe.target, 1);
    EXPECT_EQ(face.recipe.regions[1].weights, request.start_face.recipe.regions[1].weights);
    EXPECT_NE(face.recipe.regions[0].weights, request.start_face.recipe.regions[0].weights);
  }
  EXPECT_NE(faces[0].recipe.regions[0].position, faces[1].recipe.regions[0].position);
}

TEST(EditSession, BandsBeginByRegionAndALockedOneHolds) {
  const Editor editor("basis", 100'000,
                      "sampling: {bands: {build: [0.3, 0.8], skin: {smoothness: {default: 0.04, "
                      "middle: [0.1, 0.2]}}}}\n");
  const Json bands = editor.session->description().at("bands");
  EXPECT_EQ(bands[1].at("name"), "skin");
  EXPECT_EQ(bands[1].at("smoothness")[0], 0.04);
  EXPECT_NEAR(bands[1].at("smoothness")[1].get<double>(), 0.15, 1e-12);

  Json recipe = some_recipe();
  recipe["regions"]["top"] = Json::parse(R"({"weights": {"head_0": 1}, "smoothness": 1,
    "bands": {"skin": {"weights": {"head_2": 1}, "smoothness": 0.9}}})");
  constexpr std::size_t kSkinOfTop = 1;
  SampleRequest request{editor.face(recipe), {kSkinOfTop}, std::nullopt};
  request.count = 3;
  const BandRecipe& locked = request.start_face.recipe.regions[0].finer_bands[0];
  for (const FacePlan& face : editor.session->sample_faces(request)) {
    const RegionRecipe& top = face.recipe.regions[0];
    EXPECT_EQ(top.finer_bands[0].iterations, locked.iterations);
    EXPECT_EQ(top.finer_bands[0].weights, locked.weights);
    EXPECT_EQ(top.iterations, locked.iterations) << "the build, drawn lower, gives way";
    EXPECT_NE(top.weights, request.start_face.recipe.regions[0].weights);
  }
}

TEST(EditSession, FacesLikeAnotherAreNearerToItTheSmallerTheAmount) {
  const Editor editor("basis");
  SampleRequest request{editor.face(some_recipe()), {}, editor.face(some_recipe())};
  request.variation = 0;
  const FacePlan same = editor.session->sample_faces(request).front();
  EXPECT_EQ(same.recipe.regions[0].position, request.original->recipe.regions[0].position);
  EXPECT_EQ(same.recipe.regions[2].iterations, request.original->recipe.regions[2].iterations);
  const auto far = [&](double amount) {
    request.variation = amount;
    const FacePlan face = editor.session->sample_faces(request).front();
    return (*face.recipe.regions[0].position - *request.original->recipe.regions[0].position)
        .norm();
  };
  EXPECT_GT(far(0.1), 0);
  EXPECT_LT(far(0.1), far(1));
}

Json stroke_on(const EditSession& session, std::string_view mode) {
  Json stroke = {{"region", "top"}, {"mode", mode},   {"radius_mm", 25}, {"strength", 1},
                 {"falloff", 0.5},  {"mirror", true}, {"begin", true}};
  stroke["points"] = {
      {{"triangle", session.preview().triangles.size() / 6}, {"u", 0.3}, {"v", 0.3}}};
  return stroke;
}

TEST(RegionPainting, FacesAreBlendedWithWhatIsPaintedAndTakenBackExactly) {
  Editor editor("basis");
  EditSession& session = *editor.session;
  const FacePlan face = editor.face(some_recipe());
  const Positions before = session.build(face.recipe);
  RegionPainting painting(session, editor.strokes());
  const std::vector<float> masks = painting.masks();
  painting.apply_stroke(stroke_on(session, "paint"));
  EXPECT_TRUE(painting.differs_from_config());
  const std::vector<float> painted = painting.masks();
  ASSERT_EQ(painted.size(), masks.size());
  double more = 0;
  for (std::size_t i = 0; i < painted.size(); i += 3) {
    const float sum = painted[i] + painted[i + 1] + painted[i + 2];
    EXPECT_NEAR(sum, sum == 0 ? 0 : 1, 1e-6);
    more += painted[i] - masks[i];
  }
  EXPECT_NE(more, 0);
  EXPECT_EQ(session.build(face.recipe), before) << "not before it is applied";
  painting.apply_masks();
  EXPECT_NE(session.build(face.recipe), before);
  EXPECT_LT(preview_error_mm(editor, face), 0.1);
  painting.undo();
  painting.apply_masks();
  EXPECT_FALSE(painting.differs_from_config());
  EXPECT_EQ(painting.masks(), masks);
  EXPECT_EQ(session.build(face.recipe), before);
}

TEST(RegionPainting, ImagesReadBackAsWhatIsPainted) {
  Editor editor("basis");
  EditSession& session = *editor.session;
  RegionPainting painting(session, editor.strokes());
  painting.apply_stroke(stroke_on(session, "paint"));
  painting.apply_masks();
  const auto files = painting.save(painting.changed_regions({}), editor.folder / "masks.png");
  const HeadSet& head_set = session.job().inputs.head_set;
  const RegionWeights read =
      region_weights(head_set.topology, head_set.uvs, {files.begin(), files.end()}, 3);
  const RegionWeights::Alpha& alpha = session.masks().alpha;
  double sum = 0, most = 0;
  Index skin = 0;
  for (Index v = 0; v < alpha.rows(); ++v) {
    if (alpha.row(v).isZero(0)) continue;
    const double apart = (read.alpha.row(v) - alpha.row(v)).cwiseAbs().maxCoeff();
    sum += apart;
    most = std::max(most, apart);
    ++skin;
  }
  EXPECT_LT(sum / static_cast<double>(skin), 0.01) << "at most " << most;
}

TEST(RegionPainting, OutlivesTheEditorUntilMasksHoldIt) {
  Editor editor("basis");
  EditSession& session = *editor.session;
  std::vector<float> painted, masks;
  {
    RegionPainting painting(session, editor.strokes());
    masks = painting.masks();
    painting.apply_stroke(stroke_on(session, "paint"));
    painting.apply_stroke(stroke_on(session, "grow"));
    painting.undo();
    painted = painting.masks();
  }
  ASSERT_NE(painted, masks);
  std::ofstream(editor.strokes(), std::ios::app) << R"({"region": "to)";  // cut short
  {
    RegionPainting painting(session, editor.strokes());
    EXPECT_EQ(painting.masks(), painted);
    painting.apply_stroke(stroke_on(session, "smooth"));
    painting.undo();
  }
  {
    RegionPainting painting(session, editor.strokes());
    EXPECT_EQ(painting.masks(), painted);
    EXPECT_TRUE(painting.differs_from_config());
  }
  {
    std::ofstream(editor.strokes(), std::ios::app) << "{\"region\": \"chin\"}\n";
    EXPECT_EQ(RegionPainting(session, editor.strokes()).masks(), painted) << "edited by hand";
  }
  EditSession other(load_job(editor.folder / "config.yaml", {}), editor.folder / "cache", 3000);
  EXPECT_FALSE(RegionPainting(other, editor.strokes()).differs_from_config())
      << "on another preview";
  EXPECT_FALSE(RegionPainting(session, editor.strokes()).differs_from_config());

  RegionPainting painting(session, editor.strokes());
  painting.apply_stroke(stroke_on(session, "paint"));
  painting.delete_stored_strokes();
  EXPECT_FALSE(RegionPainting(session, editor.strokes()).differs_from_config());
}

TEST(RegionPainting, RegionsAreAddedRemovedAndProposed) {
  Editor editor("basis");
  RegionPainting painting(*editor.session, editor.strokes());
  painting.apply_stroke(stroke_on(*editor.session, "paint"));
  const PaintedRegions now = painting.changed_regions({});
  EXPECT_THAT(now.names, ::testing::ElementsAre("top", "middle", "bottom"));

  const PaintedRegions more = painting.changed_regions({{"add", "ears"}});
  EXPECT_THAT(more.names, ::testing::ElementsAre("top", "middle", "bottom", "ears"));
  EXPECT_EQ(more.alpha.leftCols(3), now.alpha);
  EXPECT_TRUE(more.alpha.col(3).isZero(0));

  const PaintedRegions fewer = painting.changed_regions({{"remove", "middle"}});
  EXPECT_THAT(fewer.names, ::testing::ElementsAre("top", "bottom"));
  EXPECT_EQ(painting.changed_regions({}).alpha, now.alpha) << "only asked for";
  const PaintedRegions proposed =
      painting.changed_regions({{"propose", {"brow", "nose", "mouth", "ears"}}});
  EXPECT_THAT(proposed.names, ::testing::ElementsAre("brow", "nose", "mouth", "ears"));
  for (const PaintedRegions* regions : {&more, &fewer, &proposed}) {
    EXPECT_GE(regions->alpha.minCoeff(), 0);
    EXPECT_LT((regions->alpha.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-9);
  }
  for (const auto& [change, words] :
       std::vector<std::pair<Json, std::string>>{{{{"add", 3}}, "add"},
                                                 {{{"remove", "chin"}}, "remove"},
                                                 {{{"propose", "brow"}}, "propose"},
                                                 {{{"propose", {"brow", "chin"}}}, "chin"}}) {
    testing::expect_error(ExitCode::kUsage, {words},
                          [&, &change = change] { painting.changed_regions(change); });
  }
}

TEST(RegionPainting, RefusesWhatItCannotRead) {
  Editor editor("basis");
  RegionPainting painting(*editor.session, editor.strokes());
  const Json good = stroke_on(*editor.session, "smooth");
  for (const auto& [key, value] : std::map<std::string, Json>{{"region", "chin"},
                                                              {"mode", "wipe"},
                                                              {"points", Json::array()},
                                                              {"radius_mm", 0},
                                                              {"strength", 2}}) {
    Json bad = good;
    bad[key] = value;
    testing::expect_error(ExitCode::kUsage, {key}, [&] { painting.apply_stroke(bad); });
  }
  testing::expect_error(ExitCode::kUsage, {"no stroke to undo"}, [&] { painting.undo(); });
}

}  // namespace
}  // namespace crowdface
