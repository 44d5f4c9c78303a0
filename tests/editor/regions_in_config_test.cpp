// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "crowdface/core/file.h"
#include "crowdface/editor/config_text.h"

#include "support/expect_error.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

std::string with(const std::string& text) {
  return with_regions(text, "c.yaml", {"brow", "jaw"}, {"out/edited/masks.png"});
}

constexpr const char* kSection = "regions:\n  names: [brow, jaw]\n  mask: out/edited/masks.png\n";

TEST(RegionsInConfig, BecomeTheLastSection) {
  EXPECT_EQ(with("schema: 1  # one\n"), std::string("schema: 1  # one\n\n") + kSection);
}

TEST(RegionsInConfig, ReplaceASectionInOneLine) {
  EXPECT_EQ(with("schema: 1\nregions: none\n# heads\nfaces: {}\n"),
            std::string("schema: 1\n") + kSection + "# heads\nfaces: {}\n");
  EXPECT_EQ(with("regions: {names: [a],\n  mask: b.png}\nfaces: {}\n"),
            std::string(kSection) + "faces: {}\n");
  EXPECT_EQ(with("regions:\n  {names: [a], mask: b.png}\n"), kSection);
}

TEST(RegionsInConfig, KeepCommentsAndOrderBetweenTheirKeys) {
  EXPECT_EQ(
      with("regions:  # mine\n    # images\n    mask:\n    - a.png\n    - b.png\n    # names\n"
           "    names:\n      - a\n      - b\nfaces: {}  # heads\n"),
      "regions:  # mine\n    # images\n    mask: out/edited/masks.png\n    # names\n"
      "    names: [brow, jaw]\nfaces: {}  # heads\n");
}

TEST(RegionsInConfig, AddAKeyThatIsMissing) {
  EXPECT_EQ(with("regions:\n  mask: a.png\n"), kSection);
}

TEST(RegionsInConfig, SeveralImagesAreAListAndNamesAreQuotedWhereYamlNeedsIt) {
  EXPECT_EQ(with_regions("schema: 1\n", "c.yaml", {"on"}, {"a b.png", "c,d.png"}),
            "schema: 1\n\nregions:\n  names: [\"on\"]\n  mask: [\"a b.png\", \"c,d.png\"]\n");
}

TEST(RegionsInConfig, LeavesAConfigThatNamesARegionWhichIsGone) {
  testing::SmallCrowd crowd;
  crowd.regions = 2;
  const testing::SmallCrowdFolder folder(crowd);
  write_file(folder.config(), read_file(folder.config()) +
                                  "\nrecipes:\n  - {id: eva, target: " + folder.names()[0] +
                                  ", regions: {region_2: {smoothness: 0.2, position: [0, 0]}}}\n");
  const std::string before = read_file(folder.config());
  testing::expect_error(ExitCode::kUsage, {"region_2"}, [&] {
    put_regions(folder.config(), {"region_1"}, {folder / "mask_0.png"});
  });
  EXPECT_EQ(read_file(folder.config()), before);
}

}  // namespace
}  // namespace crowdface
