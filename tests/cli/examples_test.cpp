// SPDX-License-Identifier: Apache-2.0
// What comes with the program works as it stands: the example configs and the mask in masks/.
#include <algorithm>
#include <iterator>

#include "cli/program_test.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = CROWDFACE_SOURCE_DIR;

/// The repository's layout in a folder of its own, with heads where the examples look for them.
class Examples : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::copy(kSource / "configs", folder_ / "configs");
    fs::copy(kSource / "masks", folder_ / "masks");
    const fs::path heads = folder_ / "out/demo_heads";
    crowdface(0,
              {"synth", "-o", heads.string(), "--vertices", "5000", "--count", "16", "--textures",
               "64", "--hair", "--body"},
              {});
    crowdface(0,
              {"synth", "-o", (folder_ / "out/brief_heads").string(), "--vertices", "5000",
               "--count", "24", "--textures", "64", "--hair", "--body"},
              {});
    // Stand-ins for the heads that scripts/get_heads.sh brings; one UDIM tile is all they touch.
    for (const char* model : {"ict", "makehuman"}) {
      fs::create_directories(folder_ / "heads" / model);
      for (const char* name : {"synth_01.obj", "synth_02.obj", "synth_03.obj"}) {
        fs::copy(heads / name, folder_ / "heads" / model / name);
      }
    }
    fs::copy(folder_ / "masks/synth_bands.png", folder_ / "heads/makehuman/makehuman_bands.png");
    fs::copy(folder_ / "masks/synth_bands.png", folder_ / "heads/ict/ict_bands.1001.png");
  }

  const TemporaryFolder folder_;
};

TEST_F(Examples, EachConfigMakesItsCrowd) {
  int configs = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "configs")) {
    const fs::path out = folder_ / "crowds" / entry.path().stem().string();
    crowdface(0,
              {"generate", entry.path().string(), "--count", "2", "--out", out.string(), "--cache",
               (folder_ / "cache").string(), "--set", "output.contact_sheet.cell=48"},
              {});
    const auto meshes = fs::directory_iterator(out / "meshes");
    EXPECT_GE(std::distance(fs::begin(meshes), fs::end(meshes)), 2) << entry.path();
    EXPECT_TRUE(fs::exists(out / "sheets/sheet_001.png")) << entry.path();
    ++configs;
  }
  EXPECT_GE(configs, 6);
}

TEST_F(Examples, TheCommittedMaskIsTheOneThatSynthMakes) {
  EXPECT_EQ(read_text(folder_ / "out/demo_heads/regions.png"),
            read_text(kSource / "masks/synth_bands.png"));
}

}  // namespace
}  // namespace crowdface::testing
