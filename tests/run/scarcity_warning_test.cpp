// SPDX-License-Identifier: Apache-2.0
#include "crowdface/run/scarcity_warning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/log.h"

#include "support/crowd_files.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using testing::read_text;
using testing::TemporaryFolder;

TEST(ScarcityWarning, TellsOnceThatFacesAreGettingScarce) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "log";
  CastingOptions casting;
  casting.count = 10;
  casting.diversity.min_distance_mm = 1;
  ScarcityWarning warning(casting);
  RejectionCounts few, many;
  few.add(RejectionReason::kMinDistance, 3);
  many.add(RejectionReason::kMinDistance,
           static_cast<std::uint64_t>(casting.diversity.max_attempts) / 20);
  add_log_file(path);
  warning.on_face_accepted(few);
  warning.on_face_accepted(many);
  warning.on_face_accepted(many);
  close_log_file();
  const std::string log = read_text(path);
  const auto first = log.find("candidates are getting scarce: face 2 of 10 took 50 candidates");
  EXPECT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find("getting scarce", first + 20), std::string::npos) << log;
}

TEST(TellShortfall, NamesTheHeadsOfAGroupThatHasFew) {
  Config config;
  config.faces.names = {"ann", "bob", "cyd"};
  config.groups.resize(2);
  config.groups[0].name = "old_men";
  config.groups[0].sampling.sources = {1};
  config.groups[1].name = "women";
  config.groups[1].sampling.sources = {0, 1, 2};
  config.families.resize(1);
  config.families[0].name = "brothers";
  config.families[0].group = 0;
  const auto told = [&](const Shortfall& shortfall) {
    try {
      throw_shortfall(config, {}, shortfall);
    } catch (const Unsatisfiable& error) {
      return std::string(error.what());
    }
  };
  const char* const advice = "more heads in the group old_men: its only heads are bob (the keys";
  EXPECT_THAT(told({0, {}, 0}), ::testing::HasSubstr(advice));
  EXPECT_THAT(told({0, {}, 1}), ::testing::Not(::testing::HasSubstr("more heads in the group")));
  EXPECT_THAT(told({0, {}, -1, Shortfall::What::kFamily, "brothers"}),
              ::testing::HasSubstr(advice));
}

}  // namespace
}  // namespace crowdface
