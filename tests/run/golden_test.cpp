// SPDX-License-Identifier: Apache-2.0
// Test 13 of docs/reliability.md: the bytes of three small crowds, as they stand in tests/golden.
// They must be the same with any compiler, optimisation, instruction set, number of threads and
// split into shards. Whoever changes them on purpose raises a version (docs/architecture.md) and
// runs this program with CROWDFACE_UPDATE_GOLDEN=1.
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <gtest/gtest.h>

#include "crowdface/core/hash.h"
#include "crowdface/core/instruction_set.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/run/generate.h"

#include "support/crowd_files.h"
#include "support/small_crowd.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;
using testing::SmallCrowd;
using testing::SmallCrowdFolder;

const std::string kFormats = "output.meshes=[obj, ply, glb, points]";

SmallCrowd regions_and_recipes() {
  SmallCrowd crowd;
  crowd.regions = 3;
  crowd.levels = "basis";
  crowd.count = 6;
  crowd.bowl.normals = true;
  crowd.more =
      "recipes: [{id: mine, target: bob, regions: {all: {weights: {ann: 1, cyd: 2}, smoothness: "
      "0.3}}}]\n";
  return crowd;
}

SmallCrowd families_of_a_spread_crowd() {
  SmallCrowd crowd;
  crowd.regions = 2;
  crowd.levels = "basis";
  crowd.operator_kind = "lazy";
  crowd.boundary = "free";
  crowd.count = 8;
  crowd.heads = 5;
  crowd.more =
      "plane: {layout: similarity}\ndiversity: {mode: spread, min_distance: 0.1 mm}\n"
      "families: [{name: smith, members: 3, target: bob, max_distance: 8 mm}]\n";
  return crowd;
}

SmallCrowd exact_and_printed() {
  SmallCrowd crowd;
  crowd.levels = "exact";
  crowd.normalization = "printed";
  crowd.smoothing_limit = "max_iterations: 3000";
  crowd.bowl.materials = true;
  crowd.count = 5;
  return crowd;
}

/// "file hash" a line of everything whose bits are promised (pictures are not).
std::string hashes_of(const fs::path& out) {
  std::string lines;
  for (const auto& [name, bytes] : testing::crowd_files(out)) {
    if (name != "plan.jsonl" && name != "casting.json" && !name.starts_with("meshes/")) continue;
    lines += concat(name, ' ', hash_bytes(bytes).hex(), '\n');
  }
  return lines;
}

struct Golden {
  const char* name;
  SmallCrowd (*crowd)();
};

class GoldenCrowd : public ::testing::TestWithParam<Golden> {
 protected:
  GoldenCrowd() : folder_(GetParam().crowd()) {}

  // Which sets are compared depends on the processor: scripts/bits.sh shows this line.
  static void SetUpTestSuite() {
    const std::string sets = join(instruction_sets(), " ");
    RecordProperty("instruction_sets", sets);
    std::cout << "instruction sets: " << sets << std::endl;
  }

  std::string run(int threads, const std::string& instruction_set, const Shard& shard = {}) {
    const ThreadLimit limit(threads);
    use_instruction_set(instruction_set);
    GenerateOptions options{folder_.cache(), Replace::kRefuse, false};
    options.shard = shard;
    ConfigOverrides overrides;
    overrides.assignments = {kFormats};
    generate(folder_.config(), overrides, options);
    use_instruction_set(instruction_sets().front());
    return hashes_of(folder_.out());
  }
  void forget() {
    fs::remove_all(folder_.out());
    fs::remove_all(folder_.cache());
  }
  static fs::path file() {
    return fs::path(CROWDFACE_SOURCE_DIR) / "tests/golden" / concat(GetParam().name, ".txt");
  }

  SmallCrowdFolder folder_;
};

TEST_P(GoldenCrowd, IsTheSameEverywhere) {
  const std::string found = run(2, instruction_sets().front());
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing writes the environment
  if (std::getenv("CROWDFACE_UPDATE_GOLDEN") != nullptr) std::ofstream(file()) << found;
  const std::string expected = testing::read_text(file());
  EXPECT_EQ(found, expected);
  for (const std::string& set : instruction_sets()) {
    for (const int threads : {1, 8}) {
      forget();
      EXPECT_EQ(run(threads, set), expected) << set << ", " << threads << " threads";
    }
  }
  for (const std::uint64_t shards : {2U, 7U}) {
    forget();
    for (std::uint64_t shard = 1; shard <= shards; ++shard) run(1, "portable", {shard, shards});
    gather(folder_.out(), folder_.cache());
    EXPECT_EQ(hashes_of(folder_.out()), expected) << shards << " shards";
  }
}

INSTANTIATE_TEST_SUITE_P(Three, GoldenCrowd,
                         ::testing::Values(Golden{"regions_and_recipes", regions_and_recipes},
                                           Golden{"families", families_of_a_spread_crowd},
                                           Golden{"exact_and_printed", exact_and_printed}),
                         [](const auto& golden) { return golden.param.name; });

}  // namespace
}  // namespace crowdface
