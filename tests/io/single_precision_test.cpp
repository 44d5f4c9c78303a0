// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/single_precision.h"

#include <bit>
#include <charconv>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

std::string written(double value) {
  char buffer[kMaxFloatTextLength];
  return {buffer, write_single(buffer, value)};
}

TEST(WriteSingle, IsNeverLongerThanItsRoom) {
  constexpr std::uint32_t kInfinity = 0x7f80'0000, kSign = 0x8000'0000;
  for (std::uint32_t bits = 1; bits < kInfinity; bits += 40'009) {
    const auto value = std::bit_cast<float>(bits | kSign);
    const std::string text = written(static_cast<double>(value));
    ASSERT_LE(text.size(), kMaxFloatTextLength);
    float back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(back, value);
  }
}

TEST(WriteSingle, HasNoNegativeZero) {
  EXPECT_EQ(written(0.0), "0");
  EXPECT_EQ(written(-0.0), "0");
  EXPECT_EQ(written(-1e-60), "0") << "too small for single precision";
}

}  // namespace
}  // namespace crowdface
