// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

std::string utf8_of(unsigned code) {
  const auto byte = [](unsigned value) { return static_cast<char>(value); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xc0 | code >> 6), byte(0x80 | (code & 63))};
  if (code < 0x10000) {
    return {byte(0xe0 | code >> 12), byte(0x80 | (code >> 6 & 63)), byte(0x80 | (code & 63))};
  }
  return {byte(0xf0 | code >> 18), byte(0x80 | (code >> 12 & 63)), byte(0x80 | (code >> 6 & 63)),
          byte(0x80 | (code & 63))};
}

TEST(Utf8, IsEveryCharacterButSurrogates) {
  for (unsigned code = 0; code < 0x120000; ++code) {
    const bool is_character = code < 0x110000 && (code < 0xd800 || code > 0xdfff);
    const std::string text = utf8_of(code);
    ASSERT_EQ(utf8_length(text + "x"), is_character ? text.size() : 0) << std::hex << code;
    if (text.size() > 1) {
      ASSERT_FALSE(is_utf8(text.substr(0, text.size() - 1))) << std::hex << code;
      ASSERT_FALSE(is_utf8(text.substr(1))) << std::hex << code;
    }
  }
}

TEST(Utf8, IsNoOverlongForm) {
  for (const char* text :
       {"\xc0\xaf", "\xc1\xbf", "\xe0\x80\xaf", "\xe0\x9f\xbf", "\xf0\x80\x80\xaf",
        "\xf0\x8f\xbf\xbf", "\xf8\x88\x80\x80\x80", "\xff"}) {
    EXPECT_EQ(utf8_length(text), 0U) << text;
  }
  EXPECT_TRUE(is_utf8(""));
  EXPECT_TRUE(is_utf8("häßlich, 名, 😀"));
  EXPECT_FALSE(is_utf8("h\xe4ut"));
}

}  // namespace
}  // namespace crowdface
