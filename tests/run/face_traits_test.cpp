// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/face_traits.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/run/generate.h"
#include "crowdface/run/job.h"
#include "head_models/synth/synthetic_head.h"

#include "support/crowd_files.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

/// A folder of synthetic heads, in which configs are written.
class TraitFolder {
 public:
  explicit TraitFolder(Index heads = 6) {
    const SyntheticHeads synthetic(5000, SyntheticHeads::Parts::kEyesAndTeeth);
    fs::create_directories(folder_ / "heads");
    for (Index h = 0; h < heads; ++h) {
      const Mesh mesh{synthetic.topology(),
                      synthetic.positions(3, static_cast<std::uint64_t>(h + 1)), synthetic.uvs()};
      encode_obj(mesh, "").write(folder_ / concat("heads/head_", h, ".obj"));
    }
  }
  fs::path write_config(int count, const std::string& more) {
    return folder_.write("config.yaml",
                         concat("schema: 1\ncrowd: {name: t, count: ", count,
                                ", seed: 5}\nfaces: {directory: heads, units: cm}\n", more,
                                "\noutput: {directory: out, contact_sheet: none}\n"));
  }
  void write(const std::string& name, const std::string& text) { folder_.write(name, text); }
  GenerateOptions options() const { return {folder_ / "cache", Replace::kForce, false}; }
  std::vector<FacePlan> plan_of(int count, const std::string& more) {
    const fs::path config = write_config(count, more);
    plan(config, {}, options());
    return planned(config);
  }
  std::vector<FacePlan> planned(const fs::path& config) const {
    const Job job = load_job(config, {}, folder_ / "cache");
    std::vector<FacePlan> faces;
    for (PlanLine& line : read_plan(folder_ / "out/plan.jsonl", job.names)) {
      faces.push_back(std::move(line.face));
    }
    return faces;
  }
  fs::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  testing::TemporaryFolder folder_;
};

/// The distance between two landmarks on a written mesh in millimetres, by the plain formula.
double distance_on(const Positions& mesh, const HeadLandmarks& landmarks, std::size_t a,
                   std::size_t b) {
  const auto at = [&](std::size_t l) {
    const SurfacePoint& place = *landmarks.surface_points[l];
    Eigen::RowVector3d point = Eigen::RowVector3d::Zero();
    for (std::size_t c = 0; c < 3; ++c) point += place.barycentric[c] * mesh.row(place.corners[c]);
    return point;
  };
  return 10 * (at(a) - at(b)).norm();
}

std::string every_distance() {
  std::string names;
  for (const Measurement& of : measurements()) {
    if (of.kind == Measurement::Kind::kDistance && of.name != "forehead_height") {
      names += concat(names.empty() ? "" : ", ", of.name, ": {}");
    }
  }
  return concat("traits: {", names, "}\n");
}

/// Compares the plan with the meshes. \return the largest difference in millimetres
double largest_difference_to_meshes(const fs::path& config, const fs::path& out,
                                    const std::vector<FacePlan>& faces) {
  const Job job = load_job(config, {});
  const HeadLandmarks landmarks = find_head_landmarks(job.config, job.inputs);
  const std::vector<std::size_t> named = job.config.named_traits();
  double most = 0;
  for (const FacePlan& face : faces) {
    const Positions mesh = read_obj(out / "meshes" / (face.id + ".obj")).positions;
    EXPECT_EQ(face.traits.size(), named.size());
    for (std::size_t t = 0; t < named.size(); ++t) {
      const Measurement& of = measurements()[named[t]];
      double plain = 0;
      for (const auto& side : of.landmark_indices_by_face_side) {
        plain += distance_on(mesh, landmarks, side[0], side[1]) /
                 static_cast<double>(of.landmark_indices_by_face_side.size());
      }
      const double difference = std::abs(plain - face.traits[t]);
      EXPECT_LT(difference, 0.1) << face.id << ' ' << of.name;
      most = std::max(most, difference);
    }
  }
  return most;
}

TEST(FaceTraits, AgreeWithTheWrittenMeshes) {
  const std::map<std::string, std::string> kinds = {
      {"basis", "smoothing: {levels: basis}\n"},
      {"exact", "smoothing: {levels: exact}\n"},
      {"cubic", "smoothing: {levels: cubic}\n"},
      {"mirrored", "sampling: {asymmetry: [0.3, 1.4], mirror: drawn, extrapolation: [0.7, 1.4]}\n"},
      {"no contacts", "blending: {contacts: none}\n"},
      {"neck", "neck: {like: mean}\n"},
      {"mirrored on a neck", "neck: {like: mean}\nsampling: {mirror: drawn}\n"}};
  TraitFolder folder;
  for (const auto& [kind, more] : kinds) {
    SCOPED_TRACE(kind);
    const fs::path config = folder.write_config(6, more + every_distance());
    generate(config, {}, folder.options());
    const double most =
        largest_difference_to_meshes(config, folder / "out", folder.planned(config));
    RecordProperty(kind, concat(most));
  }
}

class RealHeadTraits : public ::testing::Test {};

TEST_F(RealHeadTraits, AgreeWithTheWrittenMeshes) {
  const fs::path heads = fs::path(CROWDFACE_SOURCE_DIR) / "../shared/faces/ict16";
  if (!fs::exists(heads / "ict_00.obj")) GTEST_SKIP() << "no real heads at " << heads;
  const testing::TemporaryFolder folder;
  const fs::path config = folder.write(
      "config.yaml",
      concat("schema: 1\ncrowd: {name: t, count: 8}\nfaces: {directory: ", heads.string(),
             ", units: cm}\nsampling: {smoothness: [\"15 mm\", \"120 mm\"], extrapolation: "
             "[0.8, 1.3]}\n",
             every_distance(), "output: {directory: out, contact_sheet: none}\n"));
  generate(config, {}, {folder / "cache", Replace::kForce, false});
  const Job job = load_job(config, {}, folder / "cache");
  std::vector<FacePlan> faces;
  for (PlanLine& line : read_plan(folder / "out/plan.jsonl", job.names)) {
    faces.push_back(std::move(line.face));
  }
  const double most = largest_difference_to_meshes(config, folder / "out", faces);
  RecordProperty("largest_difference", concat(most));
}

double value_of(const FacePlan& face, const std::vector<std::string>& names,
                const std::string& name) {
  return face.traits[static_cast<std::size_t>(std::ranges::find(names, name) - names.begin())];
}

TEST(FaceTraits, EveryFaceMeetsTheLimitsOfItsCrowdGroupRecipeOrFamily) {
  TraitFolder folder(8);
  const std::string config =
      "traits: {nose_width: [20 %, 100 %]}\n"
      "groups: [{name: long, share: 0.5, traits: {face_height: [50 %, 100 %]}}]\n"
      "recipes: [{id: lead, traits: {mouth_width: {at_least: 47 mm}}}]\n"
      "families: [{name: kin, members: 3, traits: {nose_width: {}, intercanthal: [0 %, 60 %]}}]\n";
  const std::vector<FacePlan> faces = folder.plan_of(20, config);
  const Job job = load_job(folder / "config.yaml", {}, folder / "cache");
  const HeadLandmarks landmarks = find_head_landmarks(job.config, job.inputs);
  const TraitDistributions spread = measure_heads(job.config, job.inputs, landmarks);
  const auto quantile = [&](const char* name, double share) {
    return spread.quantile(*find_measurement(name), share);
  };
  constexpr double kRounding = 1e-4;
  std::map<std::string, int> counts;
  for (const FacePlan& face : faces) {
    const auto value = [&](const char* name) {
      return value_of(face, job.names.traits, name) + kRounding;
    };
    if (face.family) {
      ++counts["family"];
      EXPECT_LE(value("intercanthal") - 2 * kRounding, quantile("intercanthal", 0.6));
    } else if (!face.index) {
      ++counts["recipe"];
      EXPECT_GE(value("mouth_width"), 47);
    } else {
      ++counts[face.group.value_or("none")];
      EXPECT_GE(value("nose_width"), quantile("nose_width", 0.2)) << face.id;
      if (face.group) {
        EXPECT_GE(value("face_height"), quantile("face_height", 0.5)) << face.id;
      }
    }
  }
  const std::map<std::string, int> expected = {
      {"family", 3}, {"recipe", 1}, {"long", 10}, {"none", 10}};
  EXPECT_EQ(counts, expected);
}

TEST(FaceTraits, ALargerCrowdMovesNobody) {
  TraitFolder folder;
  folder.write("census.csv", "trait,mean,standard deviation\nmouth_width,47,2\n");
  const std::string config = "traits: {nose_width: [30 %, 100 %]}\npopulation: census.csv\n";
  const std::vector<FacePlan> few = folder.plan_of(12, config);
  const std::vector<FacePlan> many = folder.plan_of(40, config);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].recipe.target, many[i].recipe.target) << i;
    EXPECT_EQ(few[i].traits, many[i].traits) << i;
  }
}

TEST(FaceTraits, ALimitOnOneFaceChangesItAsLittleAsNecessary) {
  TraitFolder folder;
  const std::vector<FacePlan> plain = folder.plan_of(6, "traits: {nose_width: {}}\n");
  const double most = plain[2].traits.at(0) - 0.8;
  const std::vector<FacePlan> faces = folder.plan_of(
      6, concat("changes: {t_0003: {traits: {nose_width: {at_most: ", most, " mm}}}}\n"));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (i == 2) continue;
    EXPECT_EQ(faces[i].traits, plain[i].traits) << i;
  }
  EXPECT_LE(faces[2].traits.at(0), most + 1e-4);
  EXPECT_GE(faces[2].traits.at(0), most - 0.2);
}

// A face that meets its new limit needs no mixture with another face.
TEST(FaceTraits, ALimitThatAFaceMeetsLeavesItAsItIs) {
  TraitFolder folder;
  const std::vector<FacePlan> plain = folder.plan_of(6, "traits: {nose_width: {}}\n");
  const double most = plain[2].traits.at(0) + 0.8;
  const std::vector<FacePlan> faces = folder.plan_of(
      6, concat("changes: {t_0003: {traits: {nose_width: {at_most: ", most, " mm}}}}\n"));
  EXPECT_EQ(faces[2].traits, plain[2].traits);
  EXPECT_THAT(faces[2].notes.changes, ::testing::ElementsAre("config: traits"));
}

TEST(FaceTraits, SpreadCrowdsMeetTheLimitsToo) {
  TraitFolder folder;
  const std::vector<FacePlan> faces =
      folder.plan_of(8, "diversity: {mode: spread}\ntraits: {nose_width: {at_least: 60 %}}\n");
  const Job job = load_job(folder / "config.yaml", {}, folder / "cache");
  const TraitDistributions spread =
      measure_heads(job.config, job.inputs, find_head_landmarks(job.config, job.inputs));
  ASSERT_EQ(faces.size(), 8U);
  for (const FacePlan& face : faces) {
    EXPECT_GE(face.traits.at(0) + 1e-4, spread.quantile(*find_measurement("nose_width"), 0.6));
  }
}

TEST(FaceTraits, LimitsThatCannotBeMetAreToldWithTheHeadsThatReachFarthest) {
  TraitFolder folder;
  try {
    folder.plan_of(4, "traits: {nose_width: {at_least: 90 mm}, face_height: {at_most: 200 mm}}\n");
    FAIL() << "no head has such a nose";
  } catch (const Unsatisfiable& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("reached 0 of 4 faces"));
    EXPECT_THAT(error.what(),
                ::testing::ContainsRegex("nose_width at least 90.0 mm: 0 % of the drawn faces meet "
                                         "it; they reach from [0-9.]+ mm to [0-9.]+ mm; the heads "
                                         "that reach farthest: head_[0-9] \\([0-9.]+ mm\\)"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("face_height at most 200.0 mm: 100 %"));
  }
}

TEST(FaceTraits, AMeasurementThatTheHeadsLackIsRefusedWithTheReason) {
  TraitFolder folder;
  EXPECT_THAT([&] { folder.plan_of(4, "traits: {forehead_height: {}}\n"); },
              ::testing::ThrowsMessage<UsageError>(::testing::HasSubstr(
                  "forehead_height is not available on these heads, no hairline: ")));
}

TEST(FaceTraits, ALandmarkFileGivesWhatTheHeadsDoNotShow) {
  TraitFolder folder;
  folder.write("landmarks.yaml", "template: {hairline: 10}\n");
  const std::vector<FacePlan> faces =
      folder.plan_of(2, "landmarks: landmarks.yaml\ntraits: {forehead_height: {}}\n");
  EXPECT_GT(faces.at(0).traits.at(0), 0);
  folder.write("landmarks.yaml", "template: {hairlin: 10}\n");
  EXPECT_THROW(folder.plan_of(2, "landmarks: landmarks.yaml\ntraits: {forehead_height: {}}\n"),
               UsageError);
}

/// The distributions are those of the heads, so the faces can reach them.
TEST(FaceTraits, APopulationHasTheAskedDistributions) {
  TraitFolder folder(10);
  const Job job = load_job(folder.write_config(1, ""), {});
  const TraitDistributions spread =
      measure_heads(job.config, job.inputs, find_head_landmarks(job.config, job.inputs));
  std::string census;
  std::vector<TraitTarget> targets;
  for (const char* name : {"nose_width", "mouth_width", "face_height"}) {
    const std::size_t trait = *find_measurement(name);
    targets.push_back({trait, spread.mean(trait), 0.6 * spread.deviation(trait)});
    census += concat(name, ", ", targets.back().mean, ", ", targets.back().deviation, "\n");
  }
  folder.write("census.csv", census);
  const std::vector<FacePlan> faces = folder.plan_of(500, "population: census.csv\n");
  const std::vector<std::string> names = load_job(folder / "config.yaml", {}).names.traits;
  for (const TraitTarget& target : targets) {
    const std::string name(measurements()[target.trait].name);
    std::vector<double> values;
    for (const FacePlan& face : faces) values.push_back(value_of(face, names, name));
    const double difference = kolmogorov_smirnov_distance(target, values);
    RecordProperty(name, concat(difference));
    EXPECT_LT(difference, 0.08) << name;
  }
}

TEST(FaceTraits, TheReportTellsWhereTheHeadsDoNotReachThePopulation) {
  TraitFolder folder;
  folder.write("census.csv", "mouth_width,80,3\n");
  folder.plan_of(30, "population: census.csv\n");
  const auto casting = nlohmann::json::parse(testing::read_text(folder / "out/casting.json"));
  const auto& of_mouth = casting.at("traits").at("mouth_width").at("population");
  EXPECT_GT(of_mouth.at("largest_difference"), 0.9);
  EXPECT_GT(of_mouth.at("asked_above_reach"), 0.9);
  EXPECT_EQ(of_mouth.at("asked_below_reach"), 0);
}

}  // namespace
}  // namespace crowdface
