// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/landmark_lists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/legacy_text.h"
#include "crowdface/io/npy_array.h"
#include "crowdface/io/shallow_json.h"
#include "crowdface/pick/morphometric_lists.h"

namespace crowdface {
namespace {

using ListJson = nlohmann::ordered_json;

constexpr std::size_t kMaxListed = 1000;

/// Collects landmarks by name. Error messages name the file and the faulty position in the file.
class LandmarkList {
 public:
  explicit LandmarkList(const std::filesystem::path& path) : path_(path.string()) {}

  void add(std::string name, const std::vector<double>& numbers, const std::string& where) {
    if (places_.size() >= kMaxListed)
      fail(where, concat("expected at most ", kMaxListed, " landmarks"));
    name.resize(name.find_last_not_of(": ") + 1);  // "chin: 1 2 3"
    if (name.empty()) name = std::to_string(places_.size() + 1);
    LandmarkPlace place;
    place.file_location = concat(path_, where);
    place.is_vertex = numbers.size() == 1;
    if (place.is_vertex) {
      if (!(numbers[0] >= 0 && numbers[0] < 4e9) || numbers[0] != std::floor(numbers[0])) {
        fail(where, concat("expected the number of a vertex, found ", numbers[0]));
      }
      place.vertex = static_cast<std::uint64_t>(numbers[0]);
    } else if (numbers.size() == 3) {
      place.point = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
      if (!(place.point.array().abs() <= kMaxCoordinate).all())
        fail(where, "expected a point of finite numbers");
    } else {
      fail(where, concat("expected a vertex or x, y, z, found ", numbers.size(), " numbers"));
    }
    if (!places_.emplace(name, place).second) {
      fail(where, concat("two landmarks are called ", quoted(std::string_view(name))));
    }
  }
  [[noreturn]] void fail(const std::string& where, const std::string& what) const {
    throw UsageError(concat(path_, where, ": ", what));
  }
  std::map<std::string, LandmarkPlace> take() {
    if (places_.empty()) fail("", "expected landmarks, found none");
    return std::move(places_);
  }

 private:
  std::string path_;
  std::map<std::string, LandmarkPlace> places_;
};

/// The quoted value of an XML attribute, such as chin in name="chin".
std::string_view attribute_of(std::string_view tag, const std::string& name) {
  for (const char quote : {'"', '\''}) {
    const std::string key = concat(' ', name, '=', quote);
    const std::size_t at = tag.find(key);
    if (at == tag.npos) continue;
    const std::size_t end = tag.find(quote, at + key.size());
    if (end != tag.npos) return tag.substr(at + key.size(), end - at - key.size());
  }
  return {};
}

void read_picked_points(std::string_view text, LandmarkList& list) {
  std::size_t line = 1, seen = 0;
  for (std::size_t at = text.find("<point"); at != text.npos; at = text.find("<point", at + 1)) {
    std::string tag(text.substr(at, std::min(text.find_first_of("<>", at + 1), text.size()) - at));
    std::ranges::replace_if(
        tag, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    line += static_cast<std::size_t>(std::ranges::count(text.substr(seen, at - seen), '\n'));
    seen = at;
    const std::string where = concat(':', line);
    if (attribute_of(tag, "active") == "0") continue;
    std::vector<double> point;
    for (const char* axis : {"x", "y", "z"}) {
      const auto number = parse_double(attribute_of(tag, axis));
      if (!number)
        list.fail(where, concat("expected a number for the coordinate ", axis, " of the point"));
      point.push_back(*number);
    }
    list.add(std::string(attribute_of(tag, "name")), point, where);
  }
}

/// Converts a point from the axes right, anterior, superior to the axes left, posterior, superior,
/// which the mesh files of 3D Slicer have.
void turn_to_lps(std::vector<double>& point) {
  for (std::size_t axis = 0; axis < 2; ++axis) point[axis] = -point[axis];
}

/// Reads the markups of 3D Slicer before version 4.13: id, x, y, z, orientation, flags, label, ….
/// Skips points that were not placed.
void read_fcsv(std::string_view text, LandmarkList& list) {
  constexpr std::size_t kLabel = 11, kStatus = 14;
  constexpr std::string_view kPlaced = "2";
  bool is_ras = false;
  std::size_t line_number = 0;
  for (std::string_view line : split_lines(text)) {
    ++line_number;
    line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
    // Older versions of 3D Slicer write a number in this line, such as 0. In these versions, the
    // mesh files have the same axes as the points.
    if (line.starts_with("# CoordinateSystem")) is_ras = line.ends_with("RAS");
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string_view> fields = split(line, ',');
    const std::string where = concat(':', line_number);
    std::vector<double> point;
    for (std::size_t k = 1; k <= 3 && k < fields.size(); ++k) {
      if (const auto number = parse_double(fields[k])) point.push_back(*number);
    }
    if (fields.size() > kStatus && !fields[kStatus].empty() && fields[kStatus] != kPlaced) continue;
    if (point.size() != 3) list.fail(where, "expected id, x, y, z, …, as 3D Slicer writes them");
    if (is_ras) turn_to_lps(point);
    const bool is_labelled = fields.size() > kLabel && !fields[kLabel].empty();
    list.add(std::string(fields[is_labelled ? kLabel : 0]), point, where);
  }
}

/// Parses a number with a decimal point or, as some systems write it, a decimal comma. The sign may
/// be the minus sign of Unicode.
std::optional<double> parse_field(std::string_view field) {
  constexpr std::string_view kMinus = "\xE2\x88\x92";
  std::string plain(field);
  if (plain.starts_with(kMinus)) plain.replace(0, kMinus.size(), "-");
  std::ranges::replace(plain, ',', '.');
  return parse_double(plain);
}

bool is_number(std::string_view field) {
  return parse_field(field).has_value();
}

char separator_of(std::string_view line) {
  for (const char separator : {'\t', ';', ','}) {
    if (line.find(separator) != line.npos) return separator;
  }
  return ' ';
}

/// Splits a line at the separators that are not between double quotes.
std::vector<std::string_view> split_outside_quotes(std::string_view line, char separator) {
  if (std::ranges::count(line, '"') % 2 != 0) return split(line, separator);
  std::vector<std::string_view> fields;
  bool is_quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') is_quoted = !is_quoted;
    if (line[i] != separator || is_quoted) continue;
    fields.push_back(line.substr(begin, i - begin));
    begin = i + 1;
  }
  fields.push_back(line.substr(begin));
  return fields;
}

/// Splits a line into fields. Removes quotes around fields, and empty fields at the end of the
/// line.
std::vector<std::string_view> fields_of(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (std::string_view field : split_outside_quotes(line, separator)) {
    constexpr std::string_view kAround = " \t\r\"'";
    field.remove_prefix(std::min(field.find_first_not_of(kAround), field.size()));
    field = field.substr(0, field.find_last_not_of(kAround) + 1);
    if (!field.empty() || separator != ' ') fields.push_back(field);
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

/// The columns of a table whose header names the columns x, y and z, or the column vertex.
struct TableColumns {
  std::size_t count = 0;  ///< number of columns of the table; 0 if no header names these columns
  std::vector<std::size_t> numbers;  ///< indices of the columns x, y and z, or of the column vertex
  std::optional<std::size_t> name;   ///< index of the column that has the names
  /// index of the column that has 0 for points that were not placed
  std::optional<std::size_t> placed;
  bool is_ras = false;  ///< whether the axes x, y, z point right, anterior, superior
};

TableColumns columns_of(const std::vector<std::string_view>& header) {
  // Compares only the first word of a column's name: "X (mm)" and "X/Easting" are x.
  const auto find = [&](std::string_view word) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (lower_case(header[i].substr(0, header[i].find_first_of(" _/(["))) == word) return i;
    }
    return std::nullopt;
  };
  TableColumns columns;
  // 3D Slicer calls the axes by their directions: left, posterior, superior.
  for (const char* axes : {"xyz", "lps", "ras"}) {
    const auto x = find({axes, 1}), y = find({axes + 1, 1}), z = find({axes + 2, 1});
    if (!x || !y || !z || !columns.numbers.empty()) continue;
    columns.numbers = {*x, *y, *z};
    columns.is_ras = axes[0] == 'r';
  }
  const auto vertex = find("vertex");
  if (columns.numbers.empty() && vertex) columns.numbers = {*vertex};
  if (columns.numbers.empty()) return columns;
  columns.placed = find("defined");
  columns.count = header.size();
  for (const char* word : {"name", "label", "landmark", "marker", "point", "id", "index"}) {
    if (!columns.name) columns.name = find(word);
  }
  if (!columns.name && columns.numbers[0] > 0) columns.name = 0;
  return columns;
}

/// Whether a row has the name of a landmark that has no position.
bool was_not_placed(std::string_view line, const std::vector<std::string_view>& fields,
                    const TableColumns& columns) {
  if (columns.placed && *columns.placed < fields.size() && fields[*columns.placed] == "0") {
    return true;
  }
  const auto is_missing = [&](std::size_t column) {
    return column >= fields.size() || is_missing_value(fields[column]);
  };
  if (columns.count > 0) return std::ranges::all_of(columns.numbers, is_missing);
  constexpr std::ptrdiff_t kSeparators = 3;  // name, x, y, z
  const auto values = std::span(fields).subspan(1);
  return std::ranges::count(line, separator_of(line)) >= kSeparators &&
         std::ranges::all_of(values, is_missing_value);
}

/// A row of a table of landmarks.
struct TableRow {
  std::string name;  ///< empty if the row has no name
  /// one number (a vertex) or three numbers (x, y, z); any other count is an error in the row
  std::vector<double> numbers;
};

/// Reads a row whose columns the table's header names. Returns nothing if a number is missing.
std::optional<TableRow> row_by_header(const std::vector<std::string_view>& fields,
                                      const TableColumns& columns) {
  // The program R begins each row with a name, but writes no header for the column of names.
  const std::size_t shift = columns.numbers[0] == 0 && fields.size() == columns.count + 1 ? 1 : 0;
  if (fields.size() > columns.count + shift) return std::nullopt;
  TableRow row;
  const std::optional<std::size_t> name = shift == 1 ? 0 : columns.name;
  if (name && *name < fields.size()) row.name = fields[*name];
  for (const std::size_t column : columns.numbers) {
    if (column + shift >= fields.size()) return std::nullopt;
    const auto number = parse_field(fields[column + shift]);
    if (!number) return std::nullopt;
    row.numbers.push_back(*number);
  }
  if (columns.is_ras) turn_to_lps(row.numbers);
  return row;
}

/// Reads a row of a table without a header that names the columns. Returns nothing if the row has
/// several words.
std::optional<TableRow> row_by_order(const std::vector<std::string_view>& fields) {
  TableRow row;
  std::vector<double> before;  // the numbers in front of the name
  for (const std::string_view field : fields) {
    if (const auto number = parse_field(field)) {
      row.numbers.push_back(*number);
    } else if (!field.empty() && !row.name.empty()) {
      return std::nullopt;
    } else if (!field.empty()) {
      row.name = field;
      before.swap(row.numbers);
    }
  }
  if (row.name.empty()) {
    // A whole number in front of x, y, z is the name of the point.
    if (row.numbers.size() != 4 || !parse_unsigned(fields[0])) return row;
    row.name = fields[0];
    row.numbers.erase(row.numbers.begin());
  } else if (row.numbers.empty() || before.size() >= 3) {
    row.numbers = std::move(before);  // the name stands behind x, y, z or behind the vertex
    // Four numbers are a row number and x, y, z.
    if (row.numbers.size() == 4) row.numbers.erase(row.numbers.begin());
  } else if (before.size() > 1) {
    return std::nullopt;
  } else if (row.numbers.size() > 3) {
    row.numbers.resize(3);  // drop errors or colours, which stand behind x, y, z
  }
  return row;
}

/// The columns that the table's header names. Titles may stand in lines above the header.
/// \param header_line  receives the number of the header's line; 0 if there is no header
TableColumns find_columns(std::string_view text, std::size_t& header_line) {
  std::size_t line_number = 0;
  for (const std::string_view line : split_lines(text)) {
    ++line_number;
    const std::vector<std::string_view> fields = fields_of(line, separator_of(line));
    const auto number_count = std::ranges::count_if(fields, is_number);
    if (number_count >= 3) break;  // a point: headers stand above all points
    if (line.starts_with('#') || number_count > 0) continue;
    TableColumns columns = columns_of(fields);
    if (columns.count == 0) continue;
    header_line = line_number;
    return columns;
  }
  header_line = 0;
  return {};
}

/// Reads a name and numbers per line, separated by tabs, semicolons, commas or blanks. A header,
/// and lines without numbers, may come first.
void read_table(std::string_view text, LandmarkList& list) {
  std::size_t line_number = 0, header_line = 0;
  const TableColumns columns = find_columns(text, header_line);
  bool is_first = true;
  for (const std::string_view line : split_lines(text)) {
    if (++line_number <= header_line) continue;
    if (is_first && lower_case(line).starts_with("sep="))
      continue;  // a line such as "sep=;", which tells Excel the separator
    const char separator = separator_of(line);
    const std::vector<std::string_view> fields = fields_of(line, separator);
    if (fields.empty() || line[line.find_first_not_of(" \t")] == '#') continue;
    if (is_first && columns.count == 0 && std::ranges::none_of(fields, is_number)) continue;
    is_first = false;
    const std::string where = concat(':', line_number);
    if (was_not_placed(line, fields, columns)) continue;
    const auto row = columns.count > 0 ? row_by_header(fields, columns) : row_by_order(fields);
    // If only blanks separate the columns, a row such as "tip 0 1 2 3" is ambiguous: the name may
    // be "tip 0" (with the point 1, 2, 3) or "tip" (with the point 0, 1, 2 and its error 3).
    const bool is_ambiguous = separator == ' ' && columns.count == 0 && row && !row->name.empty() &&
                              !is_number(fields[0]) && fields.size() > 4;
    if (!row || row->numbers.empty() || is_ambiguous) {
      list.fail(where, concat("expected a name and x, y, z, or a name and a vertex",
                              columns.count > 0 ? ", in the columns of the header" : "",
                              separator == ' ' ? "; if names contain blanks, separate the columns "
                                                 "by commas or tabs"
                                               : ""));
    }
    list.add(row->name, row->numbers, where);
  }
}

std::vector<double> numbers_of_json(const ListJson& value) {
  std::vector<double> numbers;
  if (value.is_number()) numbers.push_back(value.get<double>());
  if (value.is_object() && value.contains("x") && value.contains("y") && value.contains("z")) {
    for (const char* axis : {"x", "y", "z"}) {
      if (value[axis].is_number()) numbers.push_back(value[axis].get<double>());
    }
  }
  if (!value.is_array()) return numbers;
  for (const ListJson& number : value) {
    if (number.is_number()) numbers.push_back(number.get<double>());
  }
  return numbers;
}

/// \param is_ras  whether the axes x, y, z point right, anterior, superior
void read_json_item(const std::string& key, const ListJson& item, bool is_ras, LandmarkList& list) {
  if (item.is_null()) return;  // the landmark was not placed
  std::string name = key;
  std::vector<double> numbers = numbers_of_json(item);
  if (item.is_object()) {
    for (const char* word : {"name", "label", "id"}) {
      if (item.contains(word) && item[word].is_string()) {
        name = item[word].get<std::string>();
        break;
      }
    }
    for (const char* word : {"position", "point", "coordinates", "coords", "coord", "location",
                             "xyz", "vertex", "index"}) {
      if (!numbers.empty() || !item.contains(word)) continue;
      if (item[word].is_null()) return;
      numbers = numbers_of_json(item[word]);
    }
  }
  // 3D Slicer: only points with the status `defined` were placed.
  const bool is_placed =
      !item.is_object() || !item.contains("positionStatus") || item["positionStatus"] == "defined";
  if (!is_placed) return;
  if (is_ras && numbers.size() == 3) turn_to_lps(numbers);
  list.add(name, numbers, name.empty() ? "" : concat(": ", name));
}

/// Reads a list of points of 3D Slicer.
void read_markup(const ListJson& markup, LandmarkList& list) {
  if (!markup.is_object() || !markup.contains("controlPoints")) return;
  const bool is_ras = markup.contains("coordinateSystem") && markup["coordinateSystem"] == "RAS";
  for (const ListJson& point : markup["controlPoints"]) read_json_item("", point, is_ras, list);
}

/// Reads a list of landmarks in JSON.
/// \return false if the text has a key `template` or `scan` (see read_landmarks), or is not JSON.
bool read_json(std::string_view text, LandmarkList& list) {
  const ListJson root = parse_shallow_json(text);
  if (root.is_discarded() || (!root.is_object() && !root.is_array())) return false;
  const ListJson* items = &root;
  if (root.is_object()) {
    if (root.contains("template") || root.contains("scan")) return false;
    if (root.contains("markups") && root["markups"].is_array()) {
      for (const ListJson& markup : root["markups"]) read_markup(markup, list);
      return true;
    }
    for (const char* word : {"landmarks", "points"}) {
      if (root.contains(word) && root[word].is_structured()) items = &root[word];
    }
  }
  for (const auto& item : items->items()) {
    read_json_item(items->is_array() ? std::string() : item.key(), item.value(), false, list);
  }
  return true;
}

void read_array(std::string_view bytes, const std::string& name, LandmarkList& list) {
  const NpyArray array = parse_npy(bytes, name);
  const std::size_t width = array.width();
  const bool sound = array.shape.size() <= 2 && (width == 1 || width == 3);
  if (!sound)
    list.fail("", "expected points (n by 3) or vertices (n), found an array of another shape");
  for (std::size_t row = 0; row < array.rows(); ++row) {
    const double* first = array.values.data() + row * width;
    list.add("", {first, first + width}, concat(": row ", row + 1));
  }
}

}  // namespace

const std::vector<std::string>& landmark_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> all = {".yaml", ".pp",   ".csv",  ".tsv", ".txt",
                                    ".xyz",  ".json", ".fcsv", ".npy", ".yml"};
    const std::vector<std::string>& others = morphometric_extensions();
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }();
  return extensions;
}

std::optional<std::map<std::string, LandmarkPlace>> parse_landmark_list(
    std::string_view bytes, const std::filesystem::path& path) {
  LandmarkList list(path);
  const std::string ending = lower_case(path.extension().string());
  if (bytes.starts_with("\x93NUMPY")) {
    read_array(bytes, path.string(), list);
    return list.take();
  }
  const auto place_of = [](std::size_t line) { return line == 0 ? "" : concat(':', line); };
  const auto fail_at_line = [&](std::size_t line, const std::string& what) {
    list.fail(place_of(line), what);
  };
  const std::string content = decoded_text(bytes);
  if (content.empty() && !bytes.empty()) list.fail("", "expected text in UTF-8 or UTF-16");
  std::string_view text = content;
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.starts_with('<') && text.find("<PickedPoints") != text.npos) {
    read_picked_points(text, list);
  } else if (text.starts_with('{') || text.starts_with('[')) {
    if (!read_json(text, list)) return std::nullopt;
  } else if (ending == ".csv" || ending == ".tsv" || ending == ".txt" || ending == ".xyz") {
    read_table(content, list);
  } else if (ending == ".fcsv") {
    read_fcsv(content, list);
  } else if (const auto landmarks = parse_morphometric_list(content, ending, fail_at_line)) {
    for (const ListedLandmark& one : *landmarks)
      list.add(one.name, one.numbers, place_of(one.line));
  } else if (ending == ".pp") {
    list.fail("", "expected an element PickedPoints, as MeshLab writes it, found none");
  } else if (!ending.empty() && ending != ".yaml" && ending != ".yml" && ending != ".json") {
    list.fail("", concat("expected landmarks as ", join(landmark_extensions())));
  } else {
    return std::nullopt;
  }
  return list.take();
}

}  // namespace crowdface
