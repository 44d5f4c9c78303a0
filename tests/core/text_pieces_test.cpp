// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/text_pieces.h"

#include <vector>

#include <gtest/gtest.h>

#include "crowdface/core/text.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

/// More items than are made at once, and more bytes than are written or read at once.
TextPieces numbered_lines(std::size_t count, std::size_t width) {
  return text_of_items(count, [width](std::size_t i) {
    return concat(i, std::string(width, static_cast<char>('a' + i % 26)), '\n');
  });
}

TEST(TextPieces, ItemsStandInTheirOrder) {
  std::string expected;
  for (std::size_t i = 0; i < 5000; ++i) expected += concat(i, ' ');
  EXPECT_EQ(whole_text(text_of_items(5000, [](std::size_t i) { return concat(i, ' '); })),
            expected);
  EXPECT_EQ(whole_text(text_of_items(0, [](std::size_t) { return std::string("none"); })), "");
}

TEST(TextPieces, DigestIsThatOfTheWhole) {
  const TextPieces text = numbered_lines(3000, 100);
  const std::string whole = whole_text(text);
  EXPECT_EQ(digest_of(text), (FileDigest{whole.size(), hash_bytes(whole)}));
  EXPECT_EQ(digest_of(numbered_lines(0, 1)), (FileDigest{0, hash_bytes("")}));
}

TEST(TextPieces, FileHoldsTheWhole) {
  const testing::TemporaryFolder folder;
  for (const std::size_t count : {0U, 1U, 9000U}) {
    const TextPieces text = numbered_lines(count, 400);
    const FileDigest written = write_file(folder / "file", text);
    EXPECT_EQ(read_file(folder / "file"), whole_text(text)) << count;
    EXPECT_TRUE(has_content(folder / "file", written)) << count;
  }
}

TEST(TextPieces, FailureLeavesTheFileAsItWas) {
  const testing::TemporaryFolder folder;
  write_file(folder / "file", "as it was");
  const TextPieces text = [](const TextSink& take) {
    take("half of it");
    throw std::runtime_error("no more");
  };
  EXPECT_THROW(write_file(folder / "file", text), std::runtime_error);
  EXPECT_EQ(read_file(folder / "file"), "as it was");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "."), {}), 1);
}

TEST(TextPieces, LinesAreThoseOfTheFile) {
  const testing::TemporaryFolder folder;
  // Some go on in the next piece that is read, one over several.
  std::vector<std::string> expected;
  for (std::size_t i = 0; i < 700; ++i) expected.push_back(std::string(7 * i, 'x') + concat(i));
  expected.emplace_back(3'000'000, 'y');
  expected.emplace_back();
  expected.emplace_back("last");
  std::string whole;
  for (const std::string& line : expected) whole += line + '\n';
  for (const bool ends : {true, false}) {
    if (!ends) whole.pop_back();
    write_file(folder / "file", whole);
    std::vector<std::string> lines;
    bool last_ended = false;
    read_lines(folder / "file", [&](std::string_view line, bool ended) {
      lines.emplace_back(line);
      last_ended = ended;
    });
    EXPECT_EQ(lines, expected);
    EXPECT_EQ(last_ended, ends);
  }
}

}  // namespace
}  // namespace crowdface
