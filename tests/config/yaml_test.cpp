// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/yaml.h"

#include <gmock/gmock.h>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Parsed {
  std::optional<YamlNode> root;
  Problems problems;
};

Parsed parse(std::string_view text) {
  Parsed parsed;
  Complaints complaints;
  parsed.root = parse_yaml(text, "f", complaints);
  complaints.report_to(parsed.problems);
  return parsed;
}

std::string place_of(const YamlNode& node, std::initializer_list<const char*> keys) {
  const YamlNode* at = &node;
  for (const char* key : keys) at = &at->find(key)->value;
  return at->place.text();
}

TEST(Yaml, KeepsPlacesPathsAndQuotes) {
  const auto [root, problems] = parse("a: 1\nb:\n  - x\n  - {c: 'd'}\n");
  ASSERT_TRUE(root && problems.empty());
  EXPECT_EQ(place_of(*root, {"a"}), "f:1:4");
  const YamlNode& list = root->find("b")->value;
  EXPECT_EQ(list.kind, YamlNode::Kind::kList);
  EXPECT_EQ(list.place.text(), "f:3:3");
  EXPECT_EQ(list.items[0].path, "b #1");
  EXPECT_FALSE(list.items[0].is_quoted);
  const YamlNode& deep = list.items[1].find("c")->value;
  EXPECT_EQ(deep.path, "b #2.c");
  EXPECT_EQ(deep.text, "d");
  EXPECT_TRUE(deep.is_quoted);
  EXPECT_EQ(deep.place.text(), "f:4:9");
}

TEST(Yaml, CountsColumnsInCharacters) {
  const auto [root, problems] = parse("\xef\xbb\xbfgröße: 1\nä: {ö: [ü, x]}\n");
  ASSERT_TRUE(root);
  EXPECT_EQ(place_of(*root, {"größe"}), "f:1:8");
  EXPECT_EQ(root->find("ä")->value.find("ö")->value.items[1].place.text(), "f:2:12");
}

TEST(Yaml, CarriageReturnsChangeNothing) {
  const auto [root, problems] = parse("a: 1\r\nb:\r\n  c: x\r\n");
  ASSERT_TRUE(root && problems.empty());
  EXPECT_EQ(root->find("a")->value.text, "1");
  EXPECT_EQ(place_of(*root, {"b", "c"}), "f:3:6");
}

// Editors of old Macs and of Windows write such files.
TEST(Yaml, ReadsLonelyCarriageReturnsAndUtf16) {
  const std::string lines = "a: 1\rb:\r  c: x\r";
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (const char c : lines) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const std::string& text : {lines, little, big}) {
    const auto [root, problems] = parse(text);
    ASSERT_TRUE(root && problems.empty());
    EXPECT_EQ(root->find("a")->value.text, "1");
    EXPECT_EQ(place_of(*root, {"b", "c"}), "f:3:6");
  }
}

TEST(Yaml, NamesCommentsAndQuotesMayHaveNoBreakSpaces) {
  const auto [root, problems] =
      parse("a: x\u00a0y #\u00a0z\u00a0\nb: ['\u3000', \"\u00a0: 'q'\u00a0\", it's\u00a0ok]\n");
  ASSERT_TRUE(root && problems.empty());
  EXPECT_EQ(root->find("a")->value.text, "x\u00a0y");
  EXPECT_EQ(root->find("b")->value.items[1].text, "\u00a0: 'q'\u00a0");
}

TEST(Yaml, PlacesAnEmptyValueAtItsKey) {
  const auto [root, problems] = parse("a:\nb: ~\nc: null\nd: 'null'\ne: [1, , 2]\n");
  ASSERT_TRUE(root && problems.empty());
  EXPECT_EQ(place_of(*root, {"a"}), "f:1:1");
  EXPECT_EQ(place_of(*root, {"b"}), "f:2:1");
  EXPECT_EQ(root->find("c")->value.kind, YamlNode::Kind::kNothing);
  EXPECT_EQ(root->find("d")->value.text, "null");
  EXPECT_EQ(root->find("e")->value.items[1].kind, YamlNode::Kind::kNothing);
  EXPECT_EQ(root->find("e")->value.items[1].place.line, 5);
}

struct Malformed {
  const char* text;
  const char* place;
  const char* phrase;
};

/// Names a case in test lists; without it they would show addresses.
void PrintTo(const Malformed& malformed, std::ostream* out) {
  *out << malformed.place;
}

class MalformedYaml : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedYaml, IsToldWithItsPlace) {
  const auto [root, problems] = parse(GetParam().text);
  ASSERT_FALSE(problems.empty());
  EXPECT_THAT(problems.messages()[0], StartsWith(concat(GetParam().place, ": ")));
  EXPECT_THAT(problems.messages()[0], HasSubstr(GetParam().phrase));
  EXPECT_EQ(problems.code(), ExitCode::kUsage);
}

INSTANTIATE_TEST_SUITE_P(
    Syntax, MalformedYaml,
    testing::Values(
        Malformed{"", "f:1:1", "found nothing"}, Malformed{"# only\n\n", "f:1:1", "found nothing"},
        Malformed{"a: [1\nb: 2\n", "f:2:2", "'[' is not closed"},
        Malformed{"a: {b: 1\n", "f:2:1", "'{' is not closed"},
        Malformed{"a: 1]\nb: ]\n", "f:2:4", "has no opening"},
        Malformed{"a: 1\n}\n", "f:2:1", "has no opening"},
        Malformed{"a: b: c\n", "f:1:5", "between quotes"},
        Malformed{"a: 1\n b: 2\n", "f:2:3", "check the indentation"},
        Malformed{"a:\n  b: 1\n c: 2\n", "f:3:2", "matches no line above"},
        Malformed{"a: - 1\n", "f:1:4", "list item"}, Malformed{"a: @x\n", "f:1:4", "cannot start"},
        Malformed{"a: `x`\n", "f:1:4", "quotes"}, Malformed{"a: %x\n", "f:1:4", "cannot start"},
        Malformed{"a: \"x\\q\"\n", "f:1:8", "begins an escape"},
        Malformed{"a: 'open\nb: 2\n", "f:1:4", "never closed"},
        Malformed{"a: \"open\\\"\nb: 2\n", "f:1:4", "never closed"},
        Malformed{"a: 'it''s open\n", "f:1:4", "never closed"},
        Malformed{"\"open: 2\n", "f:1:1", "never closed"}));

INSTANTIATE_TEST_SUITE_P(
    Refused, MalformedYaml,
    testing::Values(
        Malformed{"a: 1\nb: 2\na: 3\n", "f:3:1", "\"a\" is used twice; first in line 1"},
        Malformed{"{a: 1, a: 2}", "f:1:8", "used twice"},
        Malformed{"x:\n  a: 1\n  'a': 2\n", "f:3:3", "first in line 2"},
        Malformed{"a: &x 1\n", "f:1:4", "anchors (&x)"}, Malformed{"a: *x\n", "f:1:4", "aliases"},
        Malformed{"a: &x {b: *x}\n", "f:1:4", "anchors"},
        Malformed{"<<: {a: 1}\n", "f:1:1", "merge keys"},
        Malformed{"a: !!str 5\n", "f:1:4", "tags"}, Malformed{"a: !foo [1]\n", "f:1:4", "tags"},
        Malformed{"a: !foo\nb: 1\n", "f:1:4", "tags"},
        Malformed{"a: 1\n---\nb: 2\n", "f:2:1", "second document"},
        Malformed{"{a: 1}\nb: 2\n", "f:2:1", "after the end"},
        Malformed{"a: 1\n...\nb: 2\n", "f:3:1", "after the end"},
        Malformed{"? [x]\n: y\n", "f:1:3", "expected a key, found a list"},
        Malformed{": x\n", "f:1:1", "expected a key, found no value"},
        Malformed{"'': x\n", "f:1:1", "expected a key"}));

INSTANTIATE_TEST_SUITE_P(Bytes, MalformedYaml,
                         testing::Values(Malformed{"a: 1\nb: \xff\n", "f:2:4", "UTF-8"},
                                         Malformed{"ä: \xc3\n", "f:1:4", "UTF-8"},
                                         Malformed{"a: \xc0\x80\n", "f:1:4", "UTF-8"},
                                         Malformed{"a: \xed\xa0\x80\n", "f:1:4", "UTF-8"},
                                         Malformed{"a: \xf4\x90\x80\x80\n", "f:1:4", "UTF-8"},
                                         Malformed{"\xff\xfe"
                                                   "a",
                                                   "f:1:1", "UTF-16"},
                                         Malformed{"a: \x01\n", "f:1:4", "control character"},
                                         Malformed{"a: \x7f\n", "f:1:4", "control character"},
                                         Malformed{"a: \x02\n", "f:1:4", "save the file as UTF-8"},
                                         Malformed{"a:\u00a01\n", "f:1:3", "plain space"},
                                         Malformed{"a:\n\u00a0 b: 1\n", "f:2:1", "plain space"},
                                         Malformed{"a:\n  -\u3000b\n", "f:2:4", "plain space"},
                                         Malformed{"a: x\u2003\r\nb: 1\n", "f:1:5", "plain space"},
                                         Malformed{"a\u202f: 'x'\n", "f:1:2", "plain space"},
                                         Malformed{"a: 1\n\tb: 2\n", "f:2:1", "tab"},
                                         Malformed{"a:\n  \t- b\n", "f:2:3", "tab"}));

TEST(Yaml, JsonMayBeIndentedWithTabs) {
  const auto [root, problems] = parse("{\n\t\"a\": [\n\t\t1, 2\n\t]\n}\n");
  ASSERT_TRUE(root && problems.empty());
  EXPECT_EQ(root->find("a")->value.items.size(), 2U);
}

TEST(Yaml, NulIsRefused) {
  const auto [root, problems] = parse(std::string_view("a: \0\n", 5));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems.messages()[0], StartsWith("f:1:4: a control character"));
}

TEST(Yaml, TellsEveryDuplicateAndAnchorOfAFile) {
  const auto [root, problems] = parse("a: &x 1\nb: 2\nb: 3\nc: {d: 1, d: 2}\n");
  ASSERT_TRUE(root) << "what is left must still be checked";
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_EQ(root->find("b")->value.text, "2") << "the first of two keys stands";
}

TEST(Yaml, AliasBombIsRefusedAndNotUnfolded) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    bomb += concat("a", i, ": &a", i, " [");
    for (int k = 0; k < 10; ++k) bomb += concat("*a", i - 1, ", ");
    bomb += "]\n";
  }
  const auto [root, problems] = parse(bomb);
  ASSERT_GE(problems.size(), 2u);
  EXPECT_THAT(problems.messages()[0], StartsWith("f:1:5: anchors"));
  EXPECT_THAT(problems.messages()[2], StartsWith("f:2:10: aliases"));
  EXPECT_LE(problems.size(), 60u) << "a flood of problems buries the first";
}

TEST(Yaml, DepthBombIsRefused) {
  for (const char* opening : {"[", "{a: ", "- ", "[{b: "}) {
    std::string bomb;
    while (bomb.size() < 100'000) bomb += opening;
    const auto [root, problems] = parse(bomb);
    ASSERT_EQ(problems.size(), 1u) << opening;
    EXPECT_THAT(problems.messages()[0], HasSubstr("at most 64 levels of nesting")) << opening;
    EXPECT_FALSE(root);
  }
}

TEST(Yaml, SixtyFourLevelsAreFine) {
  const auto [root, problems] = parse(std::string(64, '[') + std::string(64, ']'));
  EXPECT_TRUE(root && problems.empty());
  EXPECT_FALSE(parse(std::string(65, '[') + std::string(65, ']')).root);
}

TEST(Yaml, TooManyValuesAndTooLongFilesAreRefused) {
  std::string many = "[";
  for (int i = 0; i < 100'001; ++i) many += "1,";
  EXPECT_THAT(parse(many + "]").problems.messages().at(0), HasSubstr("at most 100000 values"));
  const std::string comment = "a: 1\n#" + std::string(1 << 20, 'x');
  EXPECT_THAT(parse(comment).problems.messages().at(0), StartsWith("f:1:1: more than 1 MiB"));
}

// The key path of a value is kept short: a hostile file could make it grow with depth times length.
TEST(Yaml, LongKeysDoNotAddUp) {
  std::string text;
  for (int depth = 0; depth < 60; ++depth) {
    text += std::string(static_cast<std::size_t>(depth), ' ') + std::string(900, 'k') + ":\n";
  }
  const auto [root, problems] = parse(text);
  ASSERT_TRUE(root);
  const YamlNode* node = &*root;
  while (!node->entries.empty()) node = &node->entries[0].value;
  EXPECT_LT(node->path.size(), 200u);
}

class SetValue : public testing::Test {
 protected:
  void SetUp() override { root_ = *parse("crowd: {name: a}\nregions: none\nempty:\n").root; }
  std::string set(std::string_view assignment) {
    Complaints complaints;
    set_value(root_, assignment, complaints);
    Problems problems;
    complaints.report_to(problems);
    return problems.empty() ? "" : problems.messages()[0];
  }
  YamlNode root_;
};

TEST_F(SetValue, ReplacesAddsAndMakesMappings) {
  EXPECT_EQ(set("crowd.name=b"), "");
  EXPECT_EQ(set("crowd.count=7"), "");
  EXPECT_EQ(set("sampling.smoothness=[0.1, {x: 0.5}]"), "");
  EXPECT_EQ(set("empty.key=1"), "");
  EXPECT_EQ(root_.find("crowd")->value.find("name")->value.text, "b");
  EXPECT_EQ(root_.find("crowd")->value.find("count")->value.place.text(), "--set crowd.count=7");
  const YamlNode& list = root_.find("sampling")->value.find("smoothness")->value;
  EXPECT_EQ(list.items[1].find("x")->value.path, "sampling.smoothness #2.x");
  EXPECT_EQ(root_.find("empty")->value.find("key")->value.text, "1");
}

TEST_F(SetValue, KeepsEqualSignsOfTheValue) {
  EXPECT_EQ(set("crowd.name=a=b"), "");
  EXPECT_EQ(root_.find("crowd")->value.find("name")->value.text, "a=b");
}

TEST_F(SetValue, NoValueIsNothing) {
  EXPECT_EQ(set("crowd.name="), "");
  EXPECT_EQ(root_.find("crowd")->value.find("name")->value.kind, YamlNode::Kind::kNothing);
}

TEST_F(SetValue, RefusesWhatIsNoAssignment) {
  for (const char* text :
       {"", "crowd", "=1", "crowd..name=1", ".crowd=1", "crowd.=1", "a.b.c.d.e.f.g.h.i=1"}) {
    EXPECT_THAT(set(text), HasSubstr("expected key.path=value")) << text;
  }
}

TEST_F(SetValue, RefusesAPathThroughAPlainValue) {
  EXPECT_THAT(set("regions.mask=a.png"), HasSubstr("regions holds \"none\""));
  EXPECT_EQ(root_.find("regions")->value.text, "none");
}

TEST_F(SetValue, RefusesBrokenValues) {
  EXPECT_THAT(set("crowd.count=[1"),
              StartsWith("--set crowd.count=[1: in its value, column 1: a '[' is not"));
  EXPECT_THAT(set("crowd.count=*x"), HasSubstr("aliases"));
  EXPECT_THAT(set("crowd.count=@"), HasSubstr("cannot start"));
}

TEST(WriteScalar, ReadsBackAsTheSameText) {
  for (const std::string text :
       {"ann",  "../a b/c.obj", "null", "yes", "007",    "-x",    "a: b",  "#x",
        "x #y", "\"q\"",        "\\",   "é",   "a\nb\t", "",      ".",     "..",
        "...",  "<UDIM>",       "~",    "[",   "*a",     "x\x7f", " lead", "trail "}) {
    const auto [root, problems] = parse("k: " + write_scalar(text) + "\n");
    ASSERT_TRUE(root && problems.empty()) << text;
    EXPECT_EQ(root->find("k")->value.kind, YamlNode::Kind::kScalar) << text;
    EXPECT_EQ(root->find("k")->value.text, text);
  }
}

TEST(ReadYaml, MissingFilesAndFoldersAreMissingInput) {
  Complaints complaints;
  EXPECT_FALSE(read_yaml("/no/such/file.yaml", complaints));
  EXPECT_FALSE(read_yaml("/", complaints));
  Problems problems;
  complaints.report_to(problems);
  EXPECT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems.code(), ExitCode::kMissingInput);
}

}  // namespace
}  // namespace crowdface
