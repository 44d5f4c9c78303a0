// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/text.h"

#include <gtest/gtest.h>

#include "crowdface/core/random.h"

namespace crowdface {
namespace {

TEST(ParseDouble, TakesFiniteDecimalNumbersOnly) {
  EXPECT_EQ(parse_double("1.5"), 1.5);
  EXPECT_EQ(parse_double("+2"), 2.0);
  EXPECT_EQ(parse_double("-.5e1"), -5.0);
  EXPECT_EQ(parse_double("1e-400"), 0.0);  // below what a double holds
  for (const char* bad : {"", "+", "-", "nan", "inf", "-inf", "infinity", "abc", "1,5", "1 ", " 1",
                          "0x10", "1e400", "-1e400", "1.5x", "--1", "+-1", "1e", "."}) {
    EXPECT_EQ(parse_double(bad), std::nullopt) << bad;
  }
}

TEST(ParseUnsigned, RefusesSignsAndOverflow) {
  EXPECT_EQ(parse_unsigned("18446744073709551615"), UINT64_MAX);
  for (const char* bad : {"", "-1", "+1", "18446744073709551616", "1.0", "1 ", "0x1"}) {
    EXPECT_EQ(parse_unsigned(bad), std::nullopt) << bad;
  }
}

TEST(FormatNumber, ReadsBackExactly) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double value = random_between({1, i, "test", 0}, -1e3, 1e3) / 7;
    EXPECT_EQ(parse_double(format_number(value)), value);
  }
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_fixed(2.0 / 3, 3), "0.667");
}

TEST(NearestWord, SuggestsOnlyWhatIsNear) {
  const std::vector<std::string> words = {"smoothness", "extrapolation", "position"};
  EXPECT_EQ(nearest_word("smothness", words), "smoothness");
  EXPECT_EQ(nearest_word("postion", words), "position");
  EXPECT_EQ(nearest_word("colour", words), std::nullopt);
}

TEST(Quoted, EscapesAndShortens) {
  EXPECT_EQ(quoted("\xC2\x9B"
                   "1m\xE2\x80\xAE"),
            "\"\\xc2\\x9b1m\\xe2\\x80\\xae\"");
  EXPECT_EQ(quoted("a\"b\n"), "\"a\\\"b\\x0a\"");
  EXPECT_LT(quoted(std::string(1000, 'x')).size(), 100U);
  EXPECT_EQ(quoted(std::string(80, 'x')), '"' + std::string(80, 'x') + '"');
}

// A report with half a character could not be written.
TEST(Quoted, IsUtf8WhateverTheTextIs) {
  EXPECT_EQ(quoted("häu\xe4"
                   "t\xff"),
            "\"häu\\xe4t\\xff\"");
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "ä";
  for (const char* start : {"", "x", "xy", "\xe4"}) {
    EXPECT_TRUE(is_utf8(quoted(start + umlauts))) << start;
  }
  EXPECT_EQ(quoted("x" + umlauts), "\"x" + umlauts.substr(0, 78) + "…\"");
}

TEST(Concat, TakesTextAndNumbers) {
  EXPECT_EQ(concat("a", 1, ' ', 2.5, std::string("b")), "a1 2.5b");
  EXPECT_EQ(join({"a", "b", "c"}), "a, b, c");
}

TEST(Printable, NothingReachesATerminalThatItWouldObey) {
  EXPECT_EQ(printable("two\nlines, über „名“"), "two\nlines, über „名“");
  EXPECT_EQ(printable("\x1b[31m\r\t\x7f"), "\\x1b[31m\\x0d\\x09\\x7f");
  for (const char* character :
       {"\xC2\x80", "\xC2\x9F", "\xD8\x9C", "\xE2\x80\x8E", "\xE2\x80\xA8", "\xE2\x80\xAE",
        "\xE2\x81\xA6", "\xE2\x81\xA9", "\xEF\xBB\xBF", "\xE4", "\xC2"}) {
    EXPECT_EQ(printable(character).find_first_not_of("\\x0123456789abcdef"), std::string::npos);
  }
  EXPECT_EQ(printable("\xC2\xA0\xE2\x80\x8D\xE2\x82\xAC"), "\xC2\xA0\xE2\x80\x8D\xE2\x82\xAC");
}

TEST(PercentDecoded, DecodesWholeEscapesOnly) {
  EXPECT_EQ(percent_decoded("a%20b%c3%A9"), "a b\xc3\xa9");
  EXPECT_EQ(percent_decoded(""), "");
  for (const char* text : {"%", "a%2", "%g0", "%+1", "%-1", "100% wool"}) {
    EXPECT_EQ(percent_decoded(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace crowdface
