// SPDX-License-Identifier: Apache-2.0
// The tables of docs/config.md are made from the tables of keys: each stands below a line that
// names its section. The meanings are written on the page. After a change of keys run this program
// with CROWDFACE_UPDATE_REFERENCE=1.
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "crowdface/config/config_keys.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr const char* kPage = CROWDFACE_SOURCE_DIR "/docs/config.md";
constexpr std::string_view kMarker = "<!-- keys: ", kEnd = " -->";

/// "| `key` | value | default | meaning |" of keys whose meanings are known.
std::string table(const std::vector<KeyRow>& rows, const std::string& section,
                  const std::map<std::string, std::string>& meanings) {
  std::string text = "| key | value | default | meaning |\n|---|---|---|---|\n";
  for (const KeyRow& row : rows) {
    if (row.section != section) continue;
    const std::string initial = row.default_value.empty() ? "–"
                                : row.default_value == "required"
                                    ? row.default_value
                                    : concat('`', row.default_value, '`');
    const auto meaning = meanings.find(row.key);
    text += concat("| `", row.key, "` | ", row.accepted_values, " | ", initial, " | ",
                   meaning == meanings.end() ? "" : meaning->second, " |\n");
  }
  return text;
}

/// The page with the tables of these rows. \param sections  receives those that have a table.
std::string with_tables(const std::string& page, const std::vector<KeyRow>& rows,
                        std::set<std::string>& sections) {
  std::string text;
  const std::vector<std::string_view> lines = split_lines(page);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += concat(lines[i], '\n');
    if (!lines[i].starts_with(kMarker)) continue;
    const std::string section(
        lines[i].substr(kMarker.size(), lines[i].size() - kMarker.size() - kEnd.size()));
    sections.insert(section);
    std::map<std::string, std::string> meanings;
    for (; i + 1 < lines.size() && lines[i + 1].starts_with('|'); ++i) {
      std::vector<std::string_view> cells;
      std::string_view rest = lines[i + 1].substr(2);
      for (int cell = 0; cell < 3; ++cell) {
        const std::size_t end = rest.find(" | ");
        cells.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end, rest.size() - 3) + 3);
      }
      if (cells[0].size() < 2) continue;
      meanings[std::string(cells[0].substr(1, cells[0].size() - 2))] =
          rest.substr(0, rest.rfind(" |"));
    }
    text += table(rows, section, meanings);
  }
  return text;
}

TEST(KeyReference, IsThatOfTheProgram) {
  const std::vector<KeyRow> rows = config_key_rows();
  const std::string page = read_file(kPage);
  std::set<std::string> sections, expected;
  const std::string made = with_tables(page, rows, sections);
  for (const KeyRow& row : rows) expected.insert(row.section);
  EXPECT_EQ(sections, expected) << "a table for each section";
  if (std::getenv("CROWDFACE_UPDATE_REFERENCE") != nullptr) {  // NOLINT(concurrency-mt-unsafe)
    std::ofstream(kPage) << made;
  }
  EXPECT_EQ(read_file(kPage), made);
  EXPECT_EQ(made.find(" |  |\n"), std::string::npos) << "a key has no meaning";
}

}  // namespace
}  // namespace crowdface
