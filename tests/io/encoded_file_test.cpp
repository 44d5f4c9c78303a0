// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/encoded_file.h"

#include <gtest/gtest.h>

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace crowdface {
namespace {

EncodedFile three_pieces(const std::string& elsewhere) {
  EncodedFile file;
  file.add("ab");
  file.refer_to(elsewhere);
  char* own = file.reserve(10);
  own[0] = 'e';
  file.refer_to({own, 1});
  return file;
}

TEST(EncodedFile, IsItsPiecesOneAfterTheOther) {
  const std::string elsewhere = "cd";
  EncodedFile file = three_pieces(elsewhere);
  const EncodedFile moved = std::move(file);
  EXPECT_EQ(moved.text(), "abcde");
  EXPECT_EQ(moved.size(), 5U);
  EXPECT_EQ(moved.digest(), hash_bytes("abcde"));
  const testing::TemporaryFolder folder;
  moved.write(folder / "f");
  EXPECT_EQ(testing::read_text(folder / "f"), "abcde");
}

TEST(EncodedFile, NamesTheFileThatCannotBeWritten) {
  const testing::TemporaryFolder folder;
  const EncodedFile file = three_pieces("");
  testing::expect_error(ExitCode::kCannotCreate, {"nowhere/f"},
                        [&] { file.write(folder / "nowhere/f"); });
  std::filesystem::create_directories(folder / "taken/inside");
  testing::expect_error(ExitCode::kIoError, {"taken"}, [&] { file.write(folder / "taken"); });
}

}  // namespace
}  // namespace crowdface
