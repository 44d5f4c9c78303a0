// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/ict_heads.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "crowdface/core/random.h"
#include "crowdface/core/text.h"

#include "support/expect_error.h"
#include "support/model_files.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

TEST(IctHeads, AreTheNeutralPlusWeightedModes) {
  const TemporaryFolder folder;
  write_ict(folder.path(), 3);
  const IctHeads heads(folder.path());
  EXPECT_EQ(heads.mode_count(), 3U);
  EXPECT_FALSE(heads.person(1, 1));
  double sum = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::string purpose = concat("ict/mode/", k);
    sum += (k + 1) / 100.0 * std::clamp(random_normal({7, 2, purpose}), -2., 2.);
  }
  const Positions moved = heads.positions(7, 2) - heads.neutral().positions;
  for (Index v = 0; v < moved.rows(); ++v) {
    EXPECT_NEAR(moved(v, 0), sum * static_cast<double>(v % 3), 1e-12);
    EXPECT_NEAR(moved(v, 1), sum, 1e-12);
    EXPECT_NEAR(moved(v, 2), -sum, 1e-12);
  }
  EXPECT_DOUBLE_EQ(heads.heights().eye_height, 3.5);
  EXPECT_DOUBLE_EQ(heads.heights().mouth_height, 0.5);
}

TEST(IctHeads, AMeshWithoutEyesOrTeethIsRefusedByName) {
  const TemporaryFolder folder;
  for (const char* name : {"generic_neutral_mesh.obj", "identity000.obj"}) {
    folder.write(concat("FaceXModel/", name), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }
  expect_error(ExitCode::kBadData, {"generic_neutral_mesh.obj", "Sclera"},
               [&] { IctHeads(folder.path()).heights(); });
}

TEST(IctHeads, IncompleteCheckoutsAreRefused) {
  const TemporaryFolder folder;
  expect_error(ExitCode::kMissingInput, {"generic_neutral_mesh.obj"},
               [&] { IctHeads{folder.path()}; });
  write_ict(folder.path(), 0);
  expect_error(ExitCode::kMissingInput, {"identity000.obj"}, [&] { IctHeads{folder.path()}; });
  write_ict(folder.path(), 2);
  folder.write("FaceXModel/identity001.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expect_error(ExitCode::kBadData, {"identity001.obj", "not the same mesh"},
               [&] { IctHeads{folder.path()}; });
}

}  // namespace
}  // namespace crowdface::testing
