// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"

namespace crowdface::testing {

/// Expects `body` to throw an Error with this code whose message holds each of the phrases.
template <class Body>
void expect_error(ExitCode code, std::initializer_list<std::string> phrases, const Body& body) {
  try {
    body();
    ADD_FAILURE() << "expected an error with code " << static_cast<int>(code);
  } catch (const Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    for (const std::string& phrase : phrases) {
      EXPECT_THAT(std::string(error.what()), ::testing::HasSubstr(phrase));
    }
  }
}

}  // namespace crowdface::testing
