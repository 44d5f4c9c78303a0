// SPDX-License-Identifier: Apache-2.0
// The same comparison on real heads, where they are at hand: sixteen identities of the ICT face
// model, 26,719 vertices each, which are not kept in this repository.
#include <gtest/gtest.h>

#include "crowdface/core/text.h"
#include "crowdface/job/generate.h"

#include "support/bowl_heads.h"
#include "support/crowd_files.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

TEST(RealHeads, MatchThePlainMethod) {
  const fs::path heads = fs::path(CROWDFACE_SOURCE_DIR) / "../shared/faces/ict16";
  if (!fs::exists(heads / "ict_00.obj")) {
    GTEST_SKIP() << "no real heads at " << heads << ": put OBJ files ict_00.obj … there";
  }
  const testing::TemporaryFolder folder;
  const std::vector<std::string> names = {"ict_00", "ict_03", "ict_07", "ict_12"};
  std::vector<std::string> files;
  for (const std::string& name : names) files.push_back((heads / (name + ".obj")).string());
  reference::Mask mask;
  for (int tile = 1001; tile <= 1007; ++tile) {
    mask[tile] = testing::mask_picture(24, 24, static_cast<std::uint64_t>(tile));
    testing::write_mask(folder / concat("bands.", tile, ".png"), mask[tile]);
  }
  const fs::path config = folder.write(
      "config.yaml",
      concat("schema: 1\ncrowd: {name: real, count: 3, seed: 5}\nfaces: {files: [", join(files),
             "], units: cm}\n", "regions: {names: [top, middle, bottom], mask: bands.<UDIM>.png}\n",
             "smoothing: {boundary: fixed, operator: umbrella, levels: exact}\n",
             "sampling: {smoothness: [0.1, 0.6], extrapolation: [0.9, 1.2], max_sources: 2}\n",
             "output: {directory: out, contact_sheet: none}\n"));
  generate(config, {}, {folder / "cache", Replace::kRefuse, false});

  reference::Heads reference;
  reference::Obj mesh;
  for (std::size_t h = 0; h < names.size(); ++h) {
    mesh = reference::read_obj(files[h]);
    reference.positions[names[h]] = mesh.vertices;
  }
  reference.filter = reference::make_filter(mesh, true, false);
  reference.regions = {"top", "middle", "bottom"};
  reference.alpha = reference::masks_at_vertices(mesh, {mask}, 3);
  const auto lines = testing::plan_lines(folder / "out");
  ASSERT_EQ(lines.size(), 3U);
  for (const auto& line : lines) {
    const fs::path path = folder / concat("out/meshes/", line.at("id").get<std::string>(), ".obj");
    EXPECT_LT(reference::largest_difference(reference::read_obj(path).vertices,
                                            reference::blend(reference, line)),
              2e-5);
    testing::expect_same_but_positions(heads / (line.at("target").get<std::string>() + ".obj"),
                                       path);
  }
}

}  // namespace
}  // namespace crowdface
