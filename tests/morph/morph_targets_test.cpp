// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/morph_targets.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface::testing {
namespace {

// Two targets of two vertices, "a" and "b" in the order of their names, whatever the list's.
const std::string kBytes(
    "\x01\x00\x02\x00\x03\x00\xff\xff\xfe\xff\xfd\xff"
    "\xe8\x03\x00\x00\x00\x00\x00\x00\x18\xfc\x00\x80",
    24);

TEST(MorphTargets, AreThousandthsInTheOrderOfTheirNames) {
  const TemporaryFolder folder;
  const MorphTargets targets(folder.write("t.bin", kBytes),
                             {"data/targets/b.target", "data/targets/a.target"}, 2);
  Positions out = Positions::Zero(2, 3);
  const std::vector<std::uint32_t> rows = {0, 1};
  targets.add_displacements({"a", 2}, rows, out);
  EXPECT_EQ(out, (Positions(2, 3) << 0.002, 0.004, 0.006, -0.002, -0.004, -0.006).finished());
  out.setZero();
  targets.add_displacements({"b", 1}, rows, out);
  EXPECT_EQ(out, (Positions(2, 3) << 1, 0, 0, 0, -1, -32.768).finished());
  Positions one = Positions::Ones(1, 3);
  targets.add_displacements({"a", 1}, std::vector<std::uint32_t>{1}, one);
  EXPECT_EQ(one, (Positions(1, 3) << 0.999, 0.998, 0.997).finished());
}

TEST(MorphTargets, WhatDoesNotFitIsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.write("t.bin", kBytes);
  expect_error(ExitCode::kBadData, {"t.bin", "12", "24"}, [&] { MorphTargets(file, {"a"}, 2); });
  expect_error(ExitCode::kMissingInput, {"none.bin"},
               [&] { MorphTargets(folder / "none.bin", {"a"}, 2); });
  const MorphTargets targets(file, {"a", "b"}, 2);
  Positions out = Positions::Zero(2, 3);
  expect_error(ExitCode::kBadData, {"t.bin", "\"c\""}, [&] {
    targets.add_displacements({"c", 1}, std::vector<std::uint32_t>{0}, out);
  });
}

}  // namespace
}  // namespace crowdface::testing
