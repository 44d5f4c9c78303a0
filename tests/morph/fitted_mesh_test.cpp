// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/fitted_mesh.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "head_models/morph/makehuman_wardrobe.h"

#include "support/expect_error.h"
#include "support/model_files.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

class Wardrobe : public ::testing::Test {
 protected:
  Wardrobe() { write_makehuman_wardrobe(folder_.path()); }
  std::filesystem::path proxy(const std::string& name) const {
    return folder_ / "public/data/proxies" / name;
  }

  TemporaryFolder folder_;
  MakeHumanStandIn files_ = write_makehuman(folder_.path());
};

TEST_F(Wardrobe, VerticesAreMeansOfThreeOthersAndAnOffset) {
  const FittedMesh mesh = read_fitted_mesh(proxy("hair/bob01/bob01.json"), files_.vertex_count);
  Positions base = Positions::Random(files_.vertex_count, 3);
  const Positions on = mesh.fitted_to(base);
  ASSERT_EQ(on.rows(), 4);
  const Eigen::RowVector3d mean = 0.5 * base.row(kAttachmentAnchors[0]) +
                                  0.25 * base.row(kAttachmentAnchors[1]) +
                                  0.25 * base.row(kAttachmentAnchors[2]);
  EXPECT_LT(
      (on.row(2) - mean - Eigen::RowVector3d(0.2 + kAttachmentSide, kAttachmentSide, 0.01)).norm(),
      1e-12);
  base.row(kAttachmentAnchors[1]).array() += 4;
  EXPECT_LT((mesh.fitted_to(base).row(2) - on.row(2) - Eigen::RowVector3d(1, 1, 1)).norm(), 1e-12);
  EXPECT_EQ(mesh.licence.author, "Some One");
  EXPECT_EQ(mesh.pictures.at(0).path, proxy("hair/bob01/textures/bob01.png"));
}

TEST_F(Wardrobe, FilesThatAreNotWholeAreRefused) {
  const auto file = proxy("hair/bob01/bob01.json");
  const std::string whole = read_text(file);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    folder_.write("public/data/proxies/hair/bob01/bob01.json", text.replace(at, from.size(), to));
    return [&, file] { read_fitted_mesh(file, files_.vertex_count); };
  };
  expect_error(ExitCode::kBadData, {"bob01.json", "ref_vIdxs", "found 99999"},
               changed("[88,89,90]", "[88,89,99999]"));
  expect_error(ExitCode::kBadData, {"bob01.json", "ref_vIdxs", "three numbers"},
               changed("[88,89,90]", "[88,89]"));
  expect_error(ExitCode::kBadData, {"bob01.json", "weights of 4 vertices", "found 3"},
               changed("\"weights\":[[0.5,0.25,0.25],", "\"weights\":["));
  expect_error(ExitCode::kBadData, {"bob01.json", "offsets"}, changed("\"offsets\"", "\"set\""));
  expect_error(ExitCode::kBadData, {"bob01.json", "license"}, changed("\"license\":{", "\"x\":{"));
  expect_error(ExitCode::kBadData, {"bob01.json", "picture beside"},
               changed("textures/bob01.png", "../../bob01.png"));
  expect_error(ExitCode::kMissingInput, {"none.json"},
               [&] { read_fitted_mesh(proxy("none.json"), 5); });
}

TEST_F(Wardrobe, DressedHeadsKeepTheirSkinToTheBit) {
  MakeHumanHeads naked(folder_.path()), dressed(folder_.path());
  dressed.add_parts(read_makehuman_parts(folder_.path(), dressed.base_positions()).fitted_parts);
  const auto skin = static_cast<Index>(
      vertices_of_material(naked.neutral().topology, naked.materials(), {"skin"}).size());
  const Positions expected = naked.positions(3, 2), found = dressed.positions(3, 2);
  // The tube's vertices come before those of the left eye in the file, and behind those of the right one.
  EXPECT_EQ(found.topRows(skin), expected.middleRows(4, skin));
  // Eyes are without their corneas: a square on either side; then teeth and tongue.
  EXPECT_EQ(found.rows(), skin + 4 * 4);
  ASSERT_EQ(dressed.materials().size(), 5U);
  EXPECT_EQ(dressed.materials()[1].name, "eyeball_r");
  EXPECT_LT(dressed.neutral().positions(skin, 0), dressed.neutral().positions(skin + 4, 0));
  EXPECT_EQ(dressed.materials()[4].name, "tongue");
  EXPECT_EQ(dressed.neutral().topology.vertex_count, found.rows());
  EXPECT_EQ(dressed.neutral().topology.face_count(), dressed.materials()[4].first_face + 1);
}

TEST_F(Wardrobe, PartsWithoutFreeLicenceAreNotUsed) {
  EXPECT_TRUE(is_free({"AGPL3 (see also there)", "Ann", ""}));
  EXPECT_TRUE(is_free({"CC BY 4.0", "Ann", ""}));
  EXPECT_FALSE(is_free({"CC BY-NC 4.0", "Ann", ""}));
  EXPECT_FALSE(is_free({"CC BY-ND 4.0", "Ann", ""}));
  EXPECT_FALSE(is_free({"All rights reserved", "Ann", ""}));
  EXPECT_FALSE(is_free({"AGPL3", "Unknown, adapted by Ann", ""}));
  std::string eyes = read_text(proxy("eyes/HighPolyEyes/HighPolyEyes.json"));
  eyes.replace(eyes.find("AGPL3"), 5, "XYZZY");
  folder_.write("public/data/proxies/eyes/HighPolyEyes/HighPolyEyes.json", eyes);
  const MakeHumanHeads heads(folder_.path());
  expect_error(ExitCode::kBadData, {"HighPolyEyes.json", "free licence", "XYZZY"},
               [&] { read_makehuman_parts(folder_.path(), heads.base_positions()); });
}

TEST_F(Wardrobe, SkinsAreMixedByAgeAndAncestry) {
  MakeHumanPerson person{true, 34.5, {0.25, 0, 0.75}, 0.5, 0.5};
  double sum = 0, african = 0, young = 0;
  for (const WeightedSkin& share : makehuman_skin_shares(folder_.path(), person, 1, 1)) {
    const std::string name = share.picture.filename().string();
    sum += share.share;
    EXPECT_EQ(name.find("female"), std::string::npos);
    EXPECT_EQ(name.find("_asian_"), std::string::npos) << "no Asian skin: " << name;
    if (name.find("african") != std::string::npos) african += share.share;
    if (name.starts_with("young")) young += share.share;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(african, 0.25, 1e-12);
  EXPECT_NEAR(young, 0.5, 1e-12);
  EXPECT_EQ(prevailing_ancestry(person), "caucasian");
  MakeHumanPerson woman = person;
  woman.is_male = false;
  int brown = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    brown += makehuman_eye_colour(person, 1, i) == "brown" ? 1 : 0;
    const double men = makehuman_skin_optical_density_factor(person, 1, i);
    const double women = makehuman_skin_optical_density_factor(woman, 1, i);
    EXPECT_GE(women, 0.6);
    if (women > 0.6 && men < 1.25) {
      EXPECT_LT(women, men - 0.1);
    }
    EXPECT_LE(men, 1.25);
  }
  // Light colours are recessive: at a share of 0.75, Caucasian ancestry counts for 0.25 / 0.3.
  const double light = 0.75 * 0.25 / 0.3, all = 0.25 + light;
  EXPECT_NEAR(brown / 400.0, 0.25 / all * 0.9 + light / all * 0.25, 0.07);
}

TEST_F(Wardrobe, OnlyWomenHaveRedderLipsAndAThirdWearLipstick) {
  MakeHumanPerson person{false, 40, {0, 0, 1}, 0.5, 0.5};
  int lipsticks = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const auto tint = makehuman_lip_tint(person, 1, i);
    EXPECT_LT(tint[1], tint[0]);
    EXPECT_LE(tint[0], 1);
    lipsticks += tint[1] < std::exp(-0.5) ? 1 : 0;
  }
  EXPECT_NEAR(lipsticks / 400.0, 1.0 / 3, 0.07);
  person.is_male = true;
  EXPECT_EQ(makehuman_lip_tint(person, 1, 1), (std::array<double, 3>{1, 1, 1}));
}

}  // namespace
}  // namespace crowdface::testing
