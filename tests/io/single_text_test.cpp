// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/single_text.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

namespace crowdface {
namespace {

std::string written(double value) {
  char buffer[kSingleRoom];
  return {buffer, write_single(buffer, value)};
}

std::string by_the_library(float value) {
  char buffer[64];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

void expect_same(std::uint32_t bits) {
  const auto value = std::bit_cast<float>(bits);
  const std::string text = written(static_cast<double>(value));
  ASSERT_EQ(text, by_the_library(value)) << bits;
  ASSERT_LE(text.size(), kLongestSingle);
}

TEST(WriteSingle, IsTheLibrarysTextForNumbersOfAllSizes) {
  constexpr std::uint32_t kInfinity = 0x7f80'0000, kSign = 0x8000'0000;
  for (std::uint32_t bits = 1; bits < kInfinity; bits += 40'009) {
    expect_same(bits);
    expect_same(bits | kSign);
  }
}

TEST(WriteSingle, IsTheLibrarysTextForNumbersAsCoordinatesAre) {
  const auto from = std::bit_cast<std::uint32_t>(5e-4F), to = std::bit_cast<std::uint32_t>(2e5F);
  for (std::uint32_t bits = from; bits < to; bits += 1'009) expect_same(bits);
  // Around each power of two, where the gap between neighbours changes, and each power of ten.
  for (std::uint32_t power = from & 0xff80'0000; power <= to; power += 1U << 23U) {
    for (std::uint32_t bits = power - 200; bits < power + 200; ++bits) expect_same(bits);
  }
  for (float power = 1e-4F; power < 1e6F; power *= 10) {
    const auto near = std::bit_cast<std::uint32_t>(power);
    for (std::uint32_t bits = near - 200; bits < near + 200; ++bits) expect_same(bits);
  }
}

TEST(WriteSingle, IsTheLibrarysTextForShortNumbers) {
  for (int i = -100'000; i <= 100'000; i += 7) {
    for (const float scale : {1e-3F, 1e-2F, 1.0F}) {
      const float value = static_cast<float>(i) * scale;
      if (value == 0) continue;
      ASSERT_EQ(written(static_cast<double>(value)), by_the_library(value));
    }
  }
}

TEST(WriteSingle, HasNoNegativeZero) {
  EXPECT_EQ(written(0.0), "0");
  EXPECT_EQ(written(-0.0), "0");
  EXPECT_EQ(written(-1e-60), "0") << "too small for single precision";
}

}  // namespace
}  // namespace crowdface
