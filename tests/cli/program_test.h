// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.h"
#include "support/small_crowd.h"

namespace crowdface::testing {

/// Runs crowdface and expects this exit code and each of the phrases among what it says. Every
/// start costs a third of a second (image libraries), so tests are sparing with them.
inline Outcome crowdface(int code, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& phrases = {}) {
  const Outcome outcome = run_program(CROWDFACE_PROGRAM, arguments);
  std::string command;
  for (const std::string& argument : arguments) command += ' ' + argument;
  EXPECT_EQ(outcome.code, code) << command << '\n' << outcome.err;
  for (const std::string& phrase : phrases) {
    EXPECT_THAT(outcome.out + outcome.err, ::testing::HasSubstr(phrase)) << command;
  }
  EXPECT_THAT(outcome.err, ::testing::Not(::testing::HasSubstr("terminate called"))) << command;
  return outcome;
}

}  // namespace crowdface::testing
