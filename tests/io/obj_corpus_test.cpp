// SPDX-License-Identifier: Apache-2.0
// Test 6 of docs/reliability.md: malformed OBJ files are refused with file and line.
#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_file.h"

#include "support/temporary_folder.h"

namespace crowdface {
namespace {

using testing::TemporaryFolder;

const std::vector<std::string> kLines = {"# a mesh of two quads",
                                         "mtllib skin.mtl",
                                         "v 0 0 0",
                                         "v 1 0 0.5",
                                         "v 1 1 -2",
                                         "v 0 1 3e-1",
                                         "v 2 0 0",
                                         "v 2 1 0",
                                         "vt 0 0",
                                         "vt 1 0.25",
                                         "vt 1 1",
                                         "vt 0 1",
                                         "vn 0 0 1",
                                         "g head",
                                         "usemtl skin",
                                         "f 1/1/1 2/2/1 3/3/1 4/4/1",
                                         "f 2/1/1 -2/2/1 6/3/1 3/4/1"};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string text_of(const std::vector<std::string>& lines) {
  return join(lines, "\n") + "\n";
}

class ObjCorpus : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) { return folder_.write("head.obj", text); }

  /// Line `line` (from 0) instead of the good one must be refused, and named.
  void expect_refused(std::size_t line, const std::string& instead) {
    std::vector<std::string> lines = kLines;
    lines[line] = instead;
    const auto file = write(text_of(lines));
    try {
      read_obj(file);
      ADD_FAILURE() << "accepted: " << quoted(instead);
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(),
                  ::testing::StartsWith(concat(file.string(), ':', line + 1, ": expected")))
          << quoted(instead);
    }
    ++files_;
  }

  TemporaryFolder folder_;
  int files_ = 0;
};

TEST_F(ObjCorpus, EveryBadWordIsNamedWithItsLine) {
  EXPECT_EQ(read_obj(write(text_of(kLines))).topology.face_count(), 2);
  const std::vector<std::string> bad_numbers = {"nan",
                                                "inf",
                                                "-inf",
                                                "1e400",
                                                "abc",
                                                "--1",
                                                "0x10",
                                                "1,5",
                                                "+",
                                                "1e",
                                                "1e39",
                                                "1.2.3",
                                                std::string(1, '\0'),
                                                "\xff\xfe",
                                                "１",
                                                "1_000"};
  const std::vector<std::string> bad_corners = {
      "0/1/1",   "99/1/1",         "-99/1/1",
      "/1",      "1/1/1/1",        "a/1/1",
      "1.5/1/1", "4294967297/1/1", "18446744073709551617/1/1",
      "-/1/1",   "-0/1/1"};
  for (std::size_t l = 0; l < kLines.size(); ++l) {
    const std::vector<std::string> words = words_of(kLines[l]);
    const bool numbers = words[0] == "v";  // others are mended
    if (!numbers && words[0] != "f") continue;
    for (std::size_t w = 1; w < words.size(); ++w) {
      for (const std::string& bad : numbers ? bad_numbers : bad_corners) {
        std::vector<std::string> mutant = words;
        mutant[w] = bad;
        expect_refused(l, join(mutant, " "));
      }
    }
  }
  EXPECT_GE(files_, 300);
}

TEST_F(ObjCorpus, EveryBadLineIsNamed) {
  const std::size_t face = kLines.size() - 1, vertex = 4;
  for (const char* line : {"f 1/1/1 2/2/1 3/3/1 \\", "PK\x03\x04", "{\"mesh\": 1}", "<xml>"}) {
    expect_refused(face, line);
  }
  for (const char* line : {"v", "v 1", "v 1 2"}) {
    expect_refused(vertex, line);
  }
}

TEST_F(ObjCorpus, CutAnywhereIsReadOrRefused) {
  const std::string text = text_of(kLines);
  int refused = 0;
  for (std::size_t size = 0; size < text.size(); ++size) {
    const auto file = write(text.substr(0, size));
    try {
      read_obj(file);
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr(file.string()));
      ++refused;
    }
  }
  EXPECT_GT(refused, static_cast<int>(text.size() / 2));
}

TEST_F(ObjCorpus, RandomChangesAreReadOrRefused) {
  std::mt19937 random(8);
  const std::string text = text_of(kLines);
  for (int i = 0; i < 3000; ++i) {
    std::string mutant = text;
    for (unsigned changes = 1 + random() % 4; changes > 0; --changes) {
      const std::size_t at = random() % mutant.size();
      switch (random() % 3) {
        case 0:
          mutant[at] = static_cast<char>(random());
          break;
        case 1:
          mutant.erase(at, 1 + random() % 9);
          break;
        default:
          mutant.insert(at, text.substr(random() % text.size(), 1 + random() % 9));
      }
    }
    try {
      const ObjFile file = read_obj(write(mutant));
      EXPECT_TRUE(file.positions.allFinite());
      for (const std::uint32_t vertex : file.topology.corner_vertices) {
        EXPECT_LT(static_cast<Index>(vertex), file.topology.vertex_count);
      }
    } catch (const InvalidInput&) {
    }
  }
}

}  // namespace
}  // namespace crowdface
