// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/makehuman_heads.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "head_models/morph/makehuman_controls.h"

#include "support/expect_error.h"
#include "support/model_files.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

class StandIn : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  MakeHumanStandIn files_ = write_makehuman(folder_.path());
};

TEST_F(StandIn, HeadAndEyesAreCutFromTheRest) {
  const MakeHumanHeads heads(folder_.path());
  const Topology& topology = heads.neutral().topology;
  // The tube's rows at 5, 5.3 and (in front) 5.6 dm lie below the slanted cut.
  constexpr double kCut = 5.84, kSlope = 0.4;
  Index faces = 2;
  for (int j = 0; j < 12; ++j) {
    for (const auto& [z0, z1] : {std::pair(2, 1), {1, 0}, {0, -1}, {-1, -2}}) {
      faces += 5 + 0.3 * j + kSlope * 0.4 * std::min(z0, z1) > kCut ? 2 : 0;
    }
  }
  EXPECT_EQ(topology.face_count(), faces);
  ASSERT_EQ(heads.materials().size(), 3U);
  EXPECT_EQ(heads.materials()[0].name, "skin");
  EXPECT_EQ(heads.materials()[1].first_face, faces - 2);
  // Every vertex is used, texture coordinates lie where they did.
  const std::set<std::uint32_t> used(topology.corner_vertices.begin(),
                                     topology.corner_vertices.end());
  EXPECT_EQ(static_cast<Index>(used.size()), topology.vertex_count);
  EXPECT_EQ(heads.neutral().uvs.rows(), 4 * faces);
  EXPECT_DOUBLE_EQ(heads.neutral().uvs.maxCoeff(), 0.95);
  // Half-way between the eyes is the origin, in centimetres.
  EXPECT_NEAR(heads.neutral().positions.bottomRows(4).colwise().mean().x(), 3, 1e-12);
  EXPECT_NEAR(heads.heights().eye_height, 0, 1e-12);
  EXPECT_NEAR(heads.heights().mouth_height, -6.5, 1e-12);
}

TEST_F(StandIn, HeadsAreTheWeightedSumOfTargets) {
  const MakeHumanHeads heads(folder_.path());
  const MakeHumanMesh mesh =
      read_makehuman_mesh(folder_ / "public/data/models/human_full_size.json");
  Positions expected = mesh.head.positions;
  for (const TargetWeight& target : makehuman_targets(random_makehuman_person(3, 5), 3, 5)) {
    const auto place =
        std::ranges::find(files_.targets, "data/targets/" + target.target + ".target");
    ASSERT_NE(place, files_.targets.end()) << target.target;
    const auto t = static_cast<std::size_t>(place - files_.targets.begin());
    for (Index i = 0; i < expected.rows(); ++i) {
      for (Index axis = 0; axis < 3; ++axis) {
        expected(i, axis) +=
            target.weight *
            MakeHumanStandIn::thousandths(t, mesh.head_rows[static_cast<std::size_t>(i)],
                                          static_cast<std::size_t>(axis)) /
            1000.0;
      }
    }
  }
  expected = 10 * (expected.rowwise() - expected.row(0)).eval();
  Positions found = heads.positions(3, 5);
  found = (found.rowwise() - found.row(0)).eval();
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_EQ(heads.positions(3, 5), heads.positions(3, 5));
  EXPECT_NE(heads.positions(3, 5), heads.positions(3, 6));
}

TEST_F(StandIn, DamagedPackagesAreRefused) {
  const auto list = folder_ / "src/json/targets/target-list.json";
  const std::string whole = read_text(list);
  const auto put = [&](const std::string& text) {
    folder_.write("src/json/targets/target-list.json", text);
    return [&] { MakeHumanHeads{folder_.path()}; };
  };
  expect_error(ExitCode::kBadData, {"target-list.json"}, put("{"));
  std::string renamed = whole;
  renamed.replace(renamed.find("chin-cleft-in"), 13, "chin-cleft-xx");
  expect_error(ExitCode::kBadData, {"chin-cleft-in"}, put(renamed));
  put(whole);
  folder_.write("public/data/targets/targets.bin", "short");
  expect_error(ExitCode::kBadData, {"targets.bin", "found 5"},
               [&] { MakeHumanHeads{folder_.path()}; });
  folder_.write("public/data/models/human_full_size.json", R"({"vertices": [1]})");
  expect_error(ExitCode::kBadData, {"human_full_size.json"},
               [&] { MakeHumanHeads{folder_.path()}; });
  std::filesystem::remove(folder_ / "public/data/models/human_full_size.json");
  expect_error(ExitCode::kMissingInput, {"human_full_size.json"},
               [&] { MakeHumanHeads{folder_.path()}; });
}

TEST(MakeHumanPerson, SharesSumToOneAndPeopleDiffer) {
  int men = 0, old = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const MakeHumanPerson person = random_makehuman_person(1, i);
    men += person.is_male ? 1 : 0;
    old += person.age_years >= 55 ? 1 : 0;
    EXPECT_NEAR(person.ancestry[0] + person.ancestry[1] + person.ancestry[2], 1, 1e-14);
    double share = 0;
    for (const TargetWeight& target : makehuman_targets(person, 1, i)) {
      EXPECT_NE(target.weight, 0);
      EXPECT_GE(target.weight, -0.4) << "people go up to 40 % beyond the targets of their sex";
      EXPECT_LE(target.weight, 1.4);
      const bool ancestry = target.target.starts_with("macrodetails/") &&
                            target.target.find("universal") == std::string::npos;
      share += ancestry ? target.weight : 0;
    }
    EXPECT_NEAR(share, 1, 1e-12) << "sexes, ages and ancestries are mixed in proportion";
  }
  EXPECT_GT(men, 60);
  EXPECT_LT(men, 140);
  EXPECT_GT(old, 40);
}

TEST(MakeHumanTargets, EachIsNamedOnceAndNoneIsUnannounced) {
  const auto names = makehuman_target_names();
  const std::set<std::string> announced(names.begin(), names.end());
  EXPECT_GT(announced.size(), 200U);
  for (std::uint64_t i = 0; i < 50; ++i) {
    std::set<std::string> seen;
    for (const TargetWeight& target : makehuman_targets(random_makehuman_person(4, i), 4, i)) {
      EXPECT_TRUE(announced.contains(target.target)) << target.target;
      EXPECT_TRUE(seen.insert(target.target).second) << target.target;
    }
  }
}

}  // namespace
}  // namespace crowdface::testing
