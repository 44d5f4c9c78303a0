// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/morphometric_lists.h"

#include <algorithm>
#include <array>
#include <utility>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::size_t kDimensions = 3;
constexpr const char* kFlat =
    "expected x, y, z, found landmarks in two dimensions, as on a photo: pick them on the mesh";
constexpr const char* kSeveral =
    "expected the landmarks of one mesh, found several specimens: write one file for each mesh";

using Fields = std::vector<std::string_view>;

/// A line of the file: its number, from 1, and its fields, which blanks separate.
struct Line {
  std::size_t number;
  Fields fields;
};

/// Returns the lines of a text that are not empty.
std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  std::size_t number = 0;
  for (const std::string_view line : split_lines(text)) {
    Fields fields;
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != line.npos;) {
      const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
      fields.push_back(line.substr(at, end - at));
      at = end;
    }
    ++number;
    if (!fields.empty()) lines.push_back({number, std::move(fields)});
  }
  return lines;
}

/// Reads an optional name and three coordinates. If a coordinate is missing, the result has no
/// coordinates. A coordinate is missing if is_missing_value is true for it, or if it equals
/// `missing`.
ListedLandmark read_landmark(const Line& line, double missing, const FailAtLine& fail) {
  ListedLandmark landmark{{}, {}, line.number};
  bool is_missing = false;
  for (const std::string_view& field : line.fields) {
    const auto number = is_missing_value(field) ? std::nullopt : parse_double(field);
    const bool is_word = !number && !is_missing_value(field);
    if (is_word && &field == line.fields.data()) {
      landmark.name = field;
      continue;
    }
    if (is_word) {
      fail(line.number, concat("expected x, y, z, found ", quoted(field)));
    }
    is_missing = is_missing || !number || *number == missing;
    landmark.numbers.push_back(number.value_or(0));
  }
  // If a line has four numbers, the first may be a whole number that is the name of the landmark.
  if (landmark.numbers.size() == kDimensions + 1 && landmark.name.empty() &&
      parse_unsigned(line.fields[0])) {
    landmark.name = line.fields[0];
    landmark.numbers.erase(landmark.numbers.begin());
  }
  if (landmark.numbers.size() == 2) fail(line.number, kFlat);
  if (landmark.numbers.size() != kDimensions) {
    fail(line.number, concat("expected x, y, z, found ", landmark.numbers.size(), " numbers"));
  }
  if (is_missing) landmark.numbers.clear();
  return landmark;
}

using Landmarks = std::vector<ListedLandmark>;

/// Reads a .pts file of Landmark Editor or of the 300-W data set. Landmark Editor writes the
/// version, the number of points, and one line "NAME x y z" for each point. A 300-W file begins
/// with the lines "version: 1" and "n_points: 68". One line "x y z" for each point follows, in
/// braces.
Landmarks read_pts(const std::vector<Line>& lines, const FailAtLine& fail) {
  constexpr double kMissing = 9999;
  Landmarks landmarks;
  for (const Line& line : lines) {
    const std::string first = lower_case(line.fields[0]);
    const bool is_header = first.starts_with("version") || first.starts_with("n_points") ||
                           first == "{" || first == "}" || first.starts_with('#') ||
                           line.fields.size() == 1;
    if (!is_header) landmarks.push_back(read_landmark(line, kMissing, fail));
  }
  return landmarks;
}

/// TPS: the line LM3=n, then n points, and lines such as ID= and SCALE=. Ignores all other points,
/// which belong to curves.
Landmarks read_tps(const std::vector<Line>& lines, const FailAtLine& fail) {
  constexpr double kNone = -1e300;
  Landmarks landmarks;
  std::optional<std::uint64_t> left;
  for (const Line& line : lines) {
    const std::string text = lower_case(join({line.fields.begin(), line.fields.end()}, ""));
    const auto value = parse_double(std::string_view(text).substr(text.find('=') + 1));
    if (text.starts_with("lm=")) fail(line.number, kFlat);
    if (text.starts_with("scale=") && value != 1.0) {
      fail(line.number,
           "expected landmarks in the unit of the mesh, found a scale: remove this "
           "line if the coordinates are those of the mesh, else scale them");
    }
    if (text.starts_with("lm3=")) {
      if (left) fail(line.number, kSeveral);
      left = parse_unsigned(std::string_view(text).substr(4)).value_or(0);
    } else if (text.find('=') == text.npos && left.value_or(0) > 0) {
      landmarks.push_back(read_landmark(line, kNone, fail));
      --*left;
    }
  }
  if (!left || *left > 0) fail(0, "expected a line LM3=n and n lines of x, y, z");
  return landmarks;
}

/// NTSYS: comments in quotes, a header such as "1 1L 75 1 9999 DIM=3" (a rectangular matrix of 1
/// labelled row and 75 columns, in which 9999 means missing), labels, and the matrix. If the matrix
/// has as many columns as there are dimensions, each row is a point; otherwise each row has all
/// points of one specimen.
Landmarks read_nts(const std::vector<Line>& all_lines, const FailAtLine& fail) {
  std::vector<Line> lines = all_lines;
  std::erase_if(lines, [](const Line& line) {
    return line.fields[0].starts_with('"') || line.fields[0].starts_with('\'');
  });
  const auto header = lines.empty() ? Fields() : lines[0].fields;
  const std::size_t first_line = lines.empty() ? 1 : lines[0].number;
  const auto count = [&](std::size_t at) -> std::size_t {
    if (at >= header.size()) return 0;
    std::string text = lower_case(header[at]);
    if (text.ends_with('l')) text.pop_back();
    return static_cast<std::size_t>(parse_unsigned(text).value_or(0));
  };
  constexpr std::size_t kLeast = 5, kMost = 1'000'000;
  const std::size_t rows = count(1), columns = count(2);
  const std::string dimensions = header.empty() ? "" : lower_case(header.back());
  if (dimensions == "dim=2") fail(first_line, kFlat);
  if (header.size() < kLeast || header[0] != "1" || dimensions != "dim=3" || rows == 0 ||
      columns == 0 || rows > kMost || columns > kMost || columns % kDimensions != 0) {
    fail(first_line, "expected a header such as 1 1L 75 0 DIM=3");
  }
  if (rows > 1 && columns > kDimensions) fail(first_line, kSeveral);
  const double missing =
      header.size() > kLeast ? parse_double(header[4]).value_or(0) : -1e300;  // no such number
  std::vector<std::pair<std::size_t, std::string_view>> words;
  for (auto line = lines.begin() + 1; line != lines.end(); ++line) {
    for (const std::string_view word : line->fields) words.emplace_back(line->number, word);
  }
  const std::size_t size = rows * columns;
  if (words.size() < size) {
    fail(first_line,
         concat("expected ", size, " numbers, as the header says, found ", words.size()));
  }
  const std::size_t labels = words.size() - size;
  Landmarks landmarks;
  for (std::size_t i = 0; i < size / kDimensions; ++i) {
    const std::size_t at = labels + kDimensions * i;
    Line point{words[at].first, {words[at].second, words[at + 1].second, words[at + 2].second}};
    const bool is_labelled = columns == kDimensions && labels == rows;
    if (is_labelled) point.fields.insert(point.fields.begin(), words[i].second);
    landmarks.push_back(read_landmark(point, missing, fail));
  }
  return landmarks;
}

/// Amira and Avizo: a header, the line @1, and the points of the first set.
Landmarks read_amira(const std::vector<Line>& lines, const FailAtLine& fail) {
  constexpr double kNone = -1e300;
  Landmarks landmarks;
  bool is_data = false;
  for (const Line& line : lines) {
    const Fields& fields = line.fields;
    const auto sets = std::ranges::find(fields, "NumSets");
    if (sets != fields.end() && sets + 1 != fields.end() && !(sets + 1)->starts_with('1')) {
      fail(line.number, kSeveral);
    }
    if (fields[0].starts_with('#') &&
        lower_case(join({fields.begin(), fields.end()}, " ")).find("binary") != std::string::npos) {
      fail(line.number, "expected landmarks as text: save them as LandmarkSet Ascii");
    }
    if (fields[0].starts_with('@')) {
      is_data = fields[0] == "@1";
    } else if (is_data && !fields[0].starts_with('#')) {
      landmarks.push_back(read_landmark(line, kNone, fail));
    }
  }
  return landmarks;
}

struct Format {
  const char* extension;
  Landmarks (*read)(const std::vector<Line>& lines, const FailAtLine& fail);
};

constexpr std::array<Format, 5> kFormats = {{{".pts", read_pts},
                                             {".tps", read_tps},
                                             {".nts", read_nts},
                                             {".dta", read_nts},
                                             {".landmarkAscii", read_amira}}};

}  // namespace

bool is_missing_value(std::string_view field) {
  constexpr std::array<std::string_view, 5> kWords = {"", "na", "nan", "n/a", "null"};
  return std::ranges::find(kWords, lower_case(field)) != kWords.end();
}

const std::vector<std::string>& morphometric_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> all;
    for (const Format& format : kFormats) all.emplace_back(format.extension);
    return all;
  }();
  return extensions;
}

std::optional<std::vector<ListedLandmark>> parse_morphometric_list(std::string_view text,
                                                                   std::string_view extension,
                                                                   const FailAtLine& fail) {
  for (const Format& format : kFormats) {
    if (extension != lower_case(format.extension)) continue;
    Landmarks landmarks = format.read(lines_of(text), fail);
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      if (landmarks[i].name.empty()) landmarks[i].name = std::to_string(i + 1);
    }
    std::erase_if(landmarks, [](const ListedLandmark& one) { return one.numbers.empty(); });
    return landmarks;
  }
  return std::nullopt;
}

}  // namespace crowdface
