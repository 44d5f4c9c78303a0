// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/text.h"

#include "cli/program_test.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(Synth, TagsAreWhatAConfigTakes) {
  const TemporaryFolder folder;
  const std::string heads = (folder / "heads").string();
  crowdface(0, {"synth", "-o", heads, "--count", "12", "--vertices", "5000", "--tags"});
  const std::string tags = read_text(folder / "heads/tags.yaml");
  for (const char* tag : {"[female", "[male", "young", "adult", "old"}) {
    EXPECT_THAT(tags, HasSubstr(tag)) << "among twelve people";
  }
  const fs::path config = folder.write(
      "crowd.yaml", concat("schema: 1\ncrowd: {name: mob, count: 1}\noutput: {directory: out}\n",
                           tags, "  directory: heads\n  units: cm\n",
                           "sampling: {targets: [female, old], sources: [male, young, adult]}\n"));
  crowdface(0, {"check", config.string()}, {"is fine"});
}

TEST(Synth, WritesNoTagsUnasked) {
  const TemporaryFolder folder;
  crowdface(0, {"synth", "-o", folder.path().string(), "--count", "1", "--vertices", "5000"});
  EXPECT_FALSE(fs::exists(folder / "tags.yaml"));
  EXPECT_TRUE(fs::exists(folder / "synth_01.obj"));
}

}  // namespace
}  // namespace crowdface::testing
