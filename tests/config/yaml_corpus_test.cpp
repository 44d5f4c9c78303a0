// SPDX-License-Identifier: Apache-2.0
// Test 7 of docs/reliability.md: whatever is wrong with a config is told with file, line and column.
#include <random>
#include <regex>

#include <gmock/gmock.h>

#include "config/config_test_folder.h"

namespace crowdface {
namespace {

const std::vector<std::string> kLines = {
    "schema: 1",
    "crowd: {name: mob, count: 3, seed: 7}",
    "faces:",
    "  directory: heads",
    "  units: cm",
    "  align: none",
    "regions:",
    "  names: [top, mid, low]",
    "  mask: mask.png",
    "smoothing:",
    "  boundary: fixed",
    "  operator: lazy",
    "  levels: exact",
    "plane:",
    "  layout: circle",
    "sampling:",
    "  targets: all",
    "  smoothness: [0.1, 0.6]",
    "  extrapolation: 1.1",
    "diversity:",
    "  min_distance: 1 mm",
    "recipes:",
    "  - {id: mine, target: bob, regions: {all: {weights: {ann: 1}, smoothness: 0.5}}}",
    "output:",
    "  directory: out",
    "  meshes: [obj]"};

class YamlCorpus : public ConfigTest {
 protected:
  /// Reads a mutant; each of its problems must name its place. \return whether it was refused.
  bool refused(const std::string& text) {
    if (read(text)) return false;
    EXPECT_FALSE(problems_.empty()) << text;
    static const std::regex place("c\\.yaml:[1-9][0-9]*:[1-9][0-9]*: [^]+");
    std::istringstream lines(told());
    for (std::string line; std::getline(lines, line);) {
      EXPECT_TRUE(std::regex_match(line, place)) << line << "\nof\n" << text;
    }
    return true;
  }

  static std::string with_line(std::size_t line, const std::string& instead) {
    std::vector<std::string> lines = kLines;
    lines[line] = instead;
    return join(lines, "\n") + "\n";
  }
};

TEST_F(YamlCorpus, EveryProblemHasItsPlace) {
  EXPECT_FALSE(refused(join(kLines, "\n") + "\n")) << told();
  int count = 0;
  for (std::size_t l = 0; l < kLines.size(); ++l) {
    const std::string& line = kLines[l];
    const std::size_t colon = line.find(':');
    if (line.find('-') < colon) continue;
    const std::string key = line.substr(0, colon);
    EXPECT_TRUE(refused(with_line(l, concat(line, "\n", line)))) << "the key a second time";
    EXPECT_TRUE(refused(with_line(l, key + "x" + line.substr(colon)))) << "an unknown key";
    count += 2;
    const bool block = colon + 1 == line.size();
    for (const char* value : {"010",
                              "0x1F",
                              "nan",
                              ".inf",
                              "1e400",
                              "-1",
                              "~",
                              "*x",
                              "&x 1",
                              "!!int 1",
                              "\"unclosed",
                              "'unclosed",
                              "{a: 1",
                              "[1, 2",
                              "{}",
                              "[]",
                              "[[]]",
                              "{a: {b: 1}}",
                              "<<",
                              "@x",
                              "`x`",
                              "\"\\q\"",
                              "99999999999999999999",
                              "\tx",
                              "nonsense"}) {
      const std::string rest = block ? "" : "\n#";
      if (refused(with_line(l, concat(key, ": ", value, rest)))) ++count;
    }
  }
  EXPECT_GE(count, 250);
}

TEST_F(YamlCorpus, HostileFilesCostAMessage) {
  std::string bomb = "a: &a [x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c <= 'i'; ++c) {
    const std::string of = concat("*", static_cast<char>(c - 1));
    bomb += concat(c, ": &", c, " [", of, ", ", of, ", ", of, ", ", of, "]\n");
  }
  const std::vector<std::string> files = {
      "",
      "\n\n",
      "---\n---\n",
      "a: &a\n  b: *a\n",
      bomb,
      std::string(5000, '['),
      std::string(5000, '{'),
      std::string(100'000, '-'),
      concat("a: ", std::string(200, '['), "1", std::string(200, ']')),
      concat("x: [", std::string(300'000, ','), "]"),
      std::string(2 << 20, 'a'),
      concat("\"", std::string(900'000, 'a'), "\": 1"),
      std::string("schema: 1\0x", 11),
      "schema: \xff\xfe",
      "\xef\xbb\xbfschema: 2",
      "%YAML 9.9\n---\nschema: 1\n",
      "? [complex, key]\n: 1\n",
      "? a\n? b\n",
      "key: |\n  text\n bad\n",
      "a: b: c\n",
      "- a\n- b\n",
      "plain text\n",
  };
  for (const std::string& file : files) EXPECT_TRUE(refused(file)) << file.substr(0, 40);
}

TEST_F(YamlCorpus, CutAndChangedFilesAreReadOrRefusedWithAPlace) {
  const std::string text = join(kLines, "\n") + "\n";
  std::mt19937 random(9);
  for (int i = 0; i < 1500; ++i) {
    std::string mutant = text;
    const std::size_t at = random() % mutant.size();
    switch (random() % 4) {
      case 0:
        mutant.resize(at);
        break;
      case 1:
        mutant[at] = static_cast<char>(" :-[]{}&*!|>'\"%@`,#?\t\n\\010~"[random() % 28]);
        break;
      case 2:
        mutant.erase(at, 1 + random() % 7);
        break;
      default:
        mutant.insert(at, text.substr(random() % text.size(), 1 + random() % 30));
    }
    refused(mutant);
  }
}

}  // namespace
}  // namespace crowdface
