// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/pdf_pages.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/require.h"
#include "crowdface/io/image.h"

namespace crowdface {
namespace {

std::string picture(int width, int height, int channels = 3) {
  return encode_png(
      width, height, channels,
      std::vector<std::uint8_t>(static_cast<std::size_t>(width * height * channels), 90));
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++found;
  }
  return found;
}

TEST(Pdf, HasAPageForEachPicture) {
  const std::string pdf = encode_pdf(std::vector{picture(150, 75), picture(30, 40)});
  EXPECT_TRUE(pdf.starts_with("%PDF-1.4"));
  EXPECT_TRUE(pdf.ends_with("%%EOF\n"));
  EXPECT_EQ(count(pdf, "/Type /Page "), 2U);
  EXPECT_EQ(count(pdf, "/Count 2"), 1U);
  // 150 pixels an inch, 72 points an inch.
  EXPECT_EQ(count(pdf, "/MediaBox [0 0 72.000 36.000]"), 1U);
  EXPECT_EQ(count(pdf, "/Width 30 /Height 40"), 1U);
}

TEST(Pdf, TableSaysWhereEveryObjectBegins) {
  const std::string pdf = encode_pdf(std::vector{picture(20, 20), picture(30, 40), picture(8, 8)});
  const std::size_t start = pdf.rfind("startxref\n") + 10;
  const std::size_t table = std::stoul(pdf.substr(start));
  ASSERT_EQ(pdf.substr(table, 5), "xref\n");
  const std::size_t rows = pdf.find('\n', table + 5) + 1;
  const int objects = std::stoi(pdf.substr(table + 7));
  EXPECT_EQ(objects, 12);
  for (int object = 1; object < objects; ++object) {
    const std::size_t at = std::stoul(pdf.substr(rows + 20 * static_cast<std::size_t>(object), 10));
    const std::string expected = std::to_string(object) + " 0 obj\n";
    EXPECT_EQ(pdf.substr(at, expected.size()), expected);
  }
}

TEST(Pdf, HoldsThePicturesDataAsTheyAre) {
  const std::string png = picture(64, 64);
  const std::size_t data = png.find("IDAT") + 4;
  EXPECT_NE(encode_pdf(std::vector{png}).find(png.substr(data, 20)), std::string::npos);
}

TEST(Pdf, RefusesWhatIsNoRgbPicture) {
  EXPECT_THROW(encode_pdf({}), BrokenPrecondition);
  EXPECT_THROW(encode_pdf(std::vector{picture(8, 8, 4)}), BrokenPrecondition);
  EXPECT_THROW(encode_pdf(std::vector{picture(8, 8).substr(0, 50)}), BrokenPrecondition);
  EXPECT_THROW(encode_pdf(std::vector{std::string("no picture")}), BrokenPrecondition);
}

}  // namespace
}  // namespace crowdface
