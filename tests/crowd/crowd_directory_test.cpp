// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/crowd_directory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/crowd_files.h"
#include "support/expect_error.h"

namespace crowdface {
namespace {

/// A crowd of this text and no other.
CrowdConfig config_of(const std::string& text) {
  return {text, {}, [text](const std::string& other) {
            return other == text ? std::vector<std::string>()
                                 : std::vector<std::string>{"crowd.seed"};
          }};
}

TEST(CrowdDirectory, SheetsCountFromOneWithThreeDigits) {
  const CrowdDirectory directory{"/crowd"};
  EXPECT_EQ(directory.sheet(1), "/crowd/sheets/sheet_001.png");
  EXPECT_EQ(directory.sheet(1234), "/crowd/sheets/sheet_1234.png");
}

TEST(CrowdDirectory, AFaceLiesWhereTheNumberAtItsIdsEndSays) {
  const CrowdDirectory flat{"/crowd"}, numbered{"/crowd", 1000};
  EXPECT_EQ(flat.mesh("mob_012345", MeshFormat::kObj), "/crowd/meshes/mob_012345.obj");
  EXPECT_EQ(numbered.mesh("mob_012345", MeshFormat::kObj), "/crowd/meshes/012/mob_012345.obj");
  EXPECT_EQ(numbered.render("mob_000999"), "/crowd/renders/000/mob_000999.png");
  EXPECT_EQ(numbered.gallery_face("mob_1000000"), "/crowd/gallery/data/faces/1000/mob_1000000.js");
  EXPECT_EQ(numbered.numbered_subfolder("anna"), "000");
  EXPECT_EQ(numbered.numbered_subfolder("4711"), "004");
  EXPECT_EQ(numbered.numbered_subfolder("smith_2b"), "000");
  EXPECT_EQ(numbered.numbered_subfolder("x99999999999999999999"), "999999999999");
  EXPECT_EQ(numbered.sheet(12'345), "/crowd/sheets/012/sheet_12345.png");
}

TEST(CrowdDirectory, RefusalNamesTheKeyThatDiffers) {
  const testing::TemporaryFolder folder;
  const CrowdDirectory directory{folder / "crowd"};
  open_crowd_directory(directory, config_of("a\nb\nc\n"), Replace::kRefuse);
  open_crowd_directory(directory, config_of("a\nb\nc\n"),
                       Replace::kRefuse);  // the same crowd: welcome
  testing::expect_error(
      ExitCode::kUsage, {directory.root.string(), "in crowd.seed", "--force"},
      [&] { open_crowd_directory(directory, config_of("a\nB\nc\n"), Replace::kRefuse); });
  EXPECT_EQ(testing::read_text(directory.config()), "a\nb\nc\n");
}

TEST(CrowdDirectory, ForceRemovesNothingOutsideTheFolder) {
  const testing::TemporaryFolder folder;
  const CrowdDirectory directory{folder / "crowd"};
  open_crowd_directory(directory, config_of("old\n"), Replace::kRefuse);
  folder.write("victim.obj", "mine");
  folder.write("crowd/meshes/mob_0001.obj", "the crowd's");
  folder.write("crowd/meshes/..obj", "mine");
  folder.write("crowd/sheets/sheet_001.png", "the crowd's");
  folder.write("crowd/sheets/other.png", "mine");
  folder.write("crowd/plan.jsonl",
               "{\"id\":\"../../victim\"}\n{\"id\":\"mob_0001\"}\nnonsense\n{\"id\":7}\n{}\n\n");
  open_crowd_directory(directory, config_of("new\n"), Replace::kForce);
  const auto files = testing::crowd_files(folder.path());
  EXPECT_TRUE(files.contains("victim.obj"));
  EXPECT_TRUE(files.contains("crowd/sheets/other.png"));
  EXPECT_FALSE(files.contains("crowd/meshes/mob_0001.obj"));
  EXPECT_FALSE(files.contains("crowd/sheets/sheet_001.png"));
  EXPECT_FALSE(files.contains("crowd/plan.jsonl"));
  EXPECT_EQ(files.at("crowd/config.yaml"), "new\n");
}

// Two runs were started at the same time, each with its own review; one review was overwritten.
TEST(CrowdDirectory, AReviewOfAnotherRunIsNotOverwritten) {
  const testing::TemporaryFolder folder;
  const CrowdDirectory directory{folder / "crowd"};
  CrowdConfig mine = config_of("text\n"), theirs = mine;
  mine.reviews = {"mine"};
  theirs.reviews = {"theirs"};
  open_crowd_directory(directory, theirs, Replace::kRefuse);
  for (const Replace replace : {Replace::kRefuse, Replace::kForce}) {
    testing::expect_error(ExitCode::kUsage, {"review_001.yaml", "run the same command again"},
                          [&] { open_crowd_directory(directory, mine, replace); });
  }
  EXPECT_EQ(testing::read_text(directory.review(1)), "theirs");
  mine.renames_review_folder = true;
  for (int i = 0; i < 2; ++i) open_crowd_directory(directory, mine, Replace::kRefuse);
  EXPECT_EQ(testing::read_text(directory.review(1)), "mine");
  std::vector<std::string> aside;
  for (const auto& [name, text] : testing::crowd_files(directory.root)) {
    if (name.starts_with("reviews-20")) aside.push_back(text);
  }
  EXPECT_THAT(aside, ::testing::UnorderedElementsAre("theirs", "mine"));
}

TEST(CrowdDirectory, FolderOfOtherThingsIsKept) {
  const testing::TemporaryFolder folder;
  folder.write("crowd/thesis.txt", "mine");
  open_crowd_directory({folder / "crowd"}, config_of("new\n"), Replace::kRefuse);
  EXPECT_EQ(testing::read_text(folder / "crowd/thesis.txt"), "mine");
}

}  // namespace
}  // namespace crowdface
