// SPDX-License-Identifier: Apache-2.0
#include "crowdface/pick/landmark_lists.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <nlohmann/json.hpp>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/npy_array.h"
#include "crowdface/io/shallow_json.h"

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
      if (!number) list.fail(where, concat("expected a number ", axis, " of the point"));
      point.push_back(*number);
    }
    list.add(std::string(attribute_of(tag, "name")), point, where);
  }
}

/// Reads the markups of 3D Slicer before version 4.13: id, x, y, z, orientation, flags, label, ….
void read_fcsv(std::string_view text, LandmarkList& list) {
  constexpr std::size_t kLabel = 11;
  std::size_t line_number = 0;
  for (std::string_view line : split_lines(text)) {
    ++line_number;
    line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string_view> fields = split(line, ',');
    const std::string where = concat(':', line_number);
    std::vector<double> point;
    for (std::size_t k = 1; k <= 3 && k < fields.size(); ++k) {
      if (const auto number = parse_double(fields[k])) point.push_back(*number);
    }
    if (point.size() != 3) list.fail(where, "expected id, x, y, z, …, as 3D Slicer writes them");
    const bool is_labelled = fields.size() > kLabel && !fields[kLabel].empty();
    list.add(std::string(fields[is_labelled ? kLabel : 0]), point, where);
  }
}

/// Reads a name and numbers per line, separated by tabs, semicolons, commas or blanks. The first
/// line may be a header.
void read_table(std::string_view text, LandmarkList& list) {
  std::size_t line_number = 0;
  for (std::string_view line : split_lines(text)) {
    ++line_number;
    line = line.substr(0, line.find('#'));
    const char separator = line.find('\t') != line.npos  ? '\t'
                           : line.find(';') != line.npos ? ';'
                           : line.find(',') != line.npos ? ','
                                                         : ' ';
    std::string name;
    std::vector<double> numbers;
    bool has_other_words = false;
    for (std::string_view word : split(line, separator)) {
      constexpr std::string_view kAround = " \t\r\"'";
      word.remove_prefix(std::min(word.find_first_not_of(kAround), word.size()));
      word = word.substr(0, word.find_last_not_of(kAround) + 1);
      if (word.empty()) continue;
      std::string with_point(word);  // some systems write a decimal comma
      std::ranges::replace(with_point, ',', '.');
      if (const auto number = parse_double(with_point)) {
        numbers.push_back(*number);
      } else if (name.empty()) {
        name = word;
      } else {
        has_other_words = true;
      }
    }
    const bool is_header = numbers.empty() && (line_number == 1 || name.empty());
    if (is_header) continue;
    // A number that precedes the name and the point's coordinates is a row number.
    if (numbers.size() == 4 && !name.empty()) numbers.erase(numbers.begin());
    const std::string where = concat(':', line_number);
    if (has_other_words || numbers.empty()) {
      list.fail(where, "expected a name and x, y, z, or a name and a vertex");
    }
    list.add(name, numbers, where);
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

void read_json_item(const std::string& key, const ListJson& item, LandmarkList& list) {
  std::string name = key;
  std::vector<double> numbers = numbers_of_json(item);
  if (item.is_object()) {
    for (const char* word : {"name", "label", "id"}) {
      if (item.contains(word) && item[word].is_string()) {
        name = item[word].get<std::string>();
        break;
      }
    }
    for (const char* word : {"position", "point", "coordinates", "xyz", "vertex", "index"}) {
      if (numbers.empty() && item.contains(word)) numbers = numbers_of_json(item[word]);
    }
  }
  list.add(name, numbers, name.empty() ? "" : concat(": ", name));
}

/// \return false if the text has a key `template` or `scan` (see read_landmarks), or is not JSON.
bool read_json(std::string_view text, LandmarkList& list) {
  const ListJson root = parse_shallow_json(text);
  if (root.is_discarded() || (!root.is_object() && !root.is_array())) return false;
  const ListJson* items = &root;
  if (root.is_object()) {
    if (root.contains("template") || root.contains("scan")) return false;
    if (root.contains("markups") && root["markups"].is_array() && !root["markups"].empty() &&
        root["markups"][0].is_object() && root["markups"][0].contains("controlPoints")) {
      items = &root["markups"][0]["controlPoints"];
    } else {
      for (const char* word : {"landmarks", "points"}) {
        if (root.contains(word) && root[word].is_structured()) items = &root[word];
      }
    }
  }
  for (const auto& item : items->items()) {
    read_json_item(items->is_array() ? std::string() : item.key(), item.value(), list);
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

std::optional<std::map<std::string, LandmarkPlace>> parse_landmark_list(
    std::string_view bytes, const std::filesystem::path& path) {
  LandmarkList list(path);
  const std::string ending = lower_case(path.extension().string());
  std::string_view text = bytes;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (bytes.starts_with("\x93NUMPY")) {
    read_array(bytes, path.string(), list);
  } else if (text.starts_with("<!DOCTYPE PickedPoints") || text.starts_with("<PickedPoints")) {
    read_picked_points(text, list);
  } else if (text.starts_with('{') || text.starts_with('[')) {
    if (!read_json(text, list)) return std::nullopt;
  } else if (ending == ".csv" || ending == ".tsv" || ending == ".txt" || ending == ".xyz") {
    read_table(bytes, list);
  } else if (ending == ".fcsv") {
    read_fcsv(bytes, list);
  } else if (!ending.empty() && ending != ".yaml" && ending != ".yml" && ending != ".json") {
    list.fail("", "expected landmarks as .yaml, .pp, .csv, .tsv, .txt, .xyz, .json, .fcsv or .npy");
  } else {
    return std::nullopt;
  }
  return list.take();
}

}  // namespace crowdface
