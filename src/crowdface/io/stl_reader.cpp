// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/file_mesh.h"
#include "crowdface/io/foreign_file.h"

namespace crowdface {
namespace {

constexpr std::size_t kStlHeader = 84, kStlRecord = 50, kStlNormal = 12;
constexpr std::string_view kStlBlanks = " \t\r\n";

[[noreturn]] void fail_stl(const std::string& name, const std::string& found) {
  throw InvalidInput(concat(name, ": expected an STL file, found that ", found));
}

/// Reads text STL. Keywords are case-insensitive. The text after "solid" or "endsolid" is a name,
/// which ends at the line end or, in files of one line, before "facet normal" or "endsolid".
class StlText {
 public:
  StlText(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  FileMesh read() {
    std::vector<double> loop;
    for (std::string word = next(); !word.empty(); word = next()) {
      if (word == "solid" || word == "endsolid") {
        skip_name();
      } else if (word == "vertex") {
        for (int c = 0; c < 3; ++c) loop.push_back(number());
      } else if (word == "endloop" || word == "outer" || word == "endfacet") {
        add(loop);
      }
    }
    add(loop);
    mesh_.positions.resize(static_cast<Index>(numbers_.size() / 3), 3);
    std::copy(numbers_.begin(), numbers_.end(), mesh_.positions.data());
    mesh_.topology.vertex_count = mesh_.positions.rows();
    return std::move(mesh_);
  }

 private:
  std::string_view next_word() {
    const std::size_t begin = std::min(text_.find_first_not_of(kStlBlanks, at_), text_.size());
    at_ = std::min(text_.find_first_of(kStlBlanks, begin), text_.size());
    return text_.substr(begin, at_ - begin);
  }
  std::string next() {
    constexpr std::size_t kLongest = 16;
    return lower_case(next_word().substr(0, kLongest));
  }
  void skip_name() {
    constexpr std::size_t kLongestName = 1000;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    const std::string name = lower_case(text_.substr(at_, std::min(end - at_, kLongestName)));
    at_ += std::min({end - at_, name.find(" facet normal "), name.find(" endsolid")});
  }
  double number() {
    const std::string_view word = next_word();
    const auto number = parse_double(word);
    if (!number && at_ == text_.size())
      fail_stl(name_, "it ends too soon: copy or export it again");
    if (!number) {
      fail_stl(name_, concat(quoted(word), " is not a number", advice_on_bad_number(word)));
    }
    return *number;
  }
  void add(std::vector<double>& loop) {
    if (loop.empty()) return;
    if (loop.size() < 9) fail_stl(name_, "a facet has fewer than three vertices");
    auto vertex = static_cast<std::uint32_t>(numbers_.size() / 3);
    numbers_.insert(numbers_.end(), loop.begin(), loop.end());
    for (; vertex < numbers_.size() / 3; ++vertex) mesh_.topology.corner_vertices.push_back(vertex);
    mesh_.topology.face_offsets.push_back(vertex);
    loop.clear();
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::vector<double> numbers_;
  FileMesh mesh_;
};

/// Binary files may begin with "solid" too, but then no "facet" follows.
bool is_stl_text(std::string_view bytes) {
  constexpr std::size_t kLooked = 1024;
  const std::string begin = lower_case(bytes.substr(0, kLooked));
  const std::size_t first = begin.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  return first != begin.npos && begin.compare(first, 5, "solid") == 0 &&
         begin.find('\0') == begin.npos &&
         (begin.find("facet") != begin.npos || begin.find("vertex") != begin.npos ||
          begin.find("endsolid") != begin.npos);
}

}  // namespace

FileMesh parse_stl(std::string_view bytes, const std::string& name) {
  std::uint32_t claimed = 0;
  if (bytes.size() >= kStlHeader) std::memcpy(&claimed, bytes.data() + kStlHeader - 4, 4);
  const bool is_exact = bytes.size() == kStlHeader + kStlRecord * std::size_t{claimed};
  if (!is_exact && is_stl_text(bytes)) return StlText(bytes, name).read();
  const std::size_t room = bytes.size() < kStlHeader ? 0 : (bytes.size() - kStlHeader) / kStlRecord;
  const std::size_t count = claimed == 0 ? room : std::min<std::size_t>(claimed, room);
  // If the file is not STL but a text, the four bytes of `count` are letters and the number is
  // meaningless.
  if (count == 0 || (claimed > room && (bytes.size() - kStlHeader) % kStlRecord != 0)) {
    fail_stl(name, concat("it has ", bytes.size(), " bytes and claims ", claimed,
                          " triangles: copy or export it again"));
  }
  FileMesh mesh;
  if (!is_exact) {
    const std::size_t after = bytes.size() - kStlHeader - kStlRecord * count;
    mesh.notes.push_back(
        count == claimed
            ? concat(after, " bytes after its last triangle are not read")
            : concat("it claims ", claimed, " triangles and holds ", room, ", which are read"));
  }
  mesh.positions.resize(static_cast<Index>(3 * count), 3);
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t i = 0; i < 9; ++i) {
      float value = 0;
      std::memcpy(&value, bytes.data() + kStlHeader + kStlRecord * t + kStlNormal + 4 * i, 4);
      mesh.positions.data()[9 * t + i] = value;
    }
    for (std::uint32_t c = 0; c < 3; ++c) {
      mesh.topology.corner_vertices.push_back(static_cast<std::uint32_t>(3 * t) + c);
    }
    mesh.topology.face_offsets.push_back(static_cast<std::uint32_t>(3 * t) + 3);
  }
  mesh.topology.vertex_count = mesh.positions.rows();
  return mesh;
}

}  // namespace crowdface
