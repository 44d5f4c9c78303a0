// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_scan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::size_t kMostCorners = 255;  // the loader counts corners in a byte
constexpr std::uint64_t kMostPerVertex = 8;
constexpr std::size_t kLongestName = 1000;  // of a material, a group, a list of material files
constexpr double kLargestCoordinate = 1e7;  // beyond, single precision keeps no tenth of a unit

/// Statements that carry no geometry we blend; they are copied through.
constexpr std::array<std::string_view, 31> kOtherStatements = {
    "g",        "s",        "o",    "usemtl", "mtllib", "l",          "p",        "vp",
    "cstype",   "deg",      "bmat", "step",   "curv",   "curv2",      "surf",     "parm",
    "trim",     "hole",     "scrv", "sp",     "end",    "con",        "mg",       "bevel",
    "c_interp", "d_interp", "lod",  "usemap", "maplib", "shadow_obj", "trace_obj"};

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// Splits a line into its words without copying.
void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  for (std::size_t i = 0; i < line.size();) {
    if (is_blank(line[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < line.size() && !is_blank(line[end])) ++end;
    words.push_back(line.substr(i, end - i));
    i = end;
  }
}

std::string_view rest_after(std::string_view line, std::string_view word) {
  const char* begin = word.data() + word.size();
  std::string_view rest(begin, static_cast<std::size_t>(line.data() + line.size() - begin));
  while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
  return rest;
}

struct Counts {
  std::uint64_t vertices = 0, uvs = 0, normals = 0, faces = 0;
};

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  ObjScan run() {
    if (text_.starts_with("\xEF\xBB\xBF")) {
      fail("expected plain text, found a byte-order mark; save the file as UTF-8 without BOM");
    }
    for_each_line([&](std::string_view line) { count(line); });
    require_at_most(input_limits().vertices, total_.vertices, "vertices");
    // A vertex may have several of these, but not without end.
    require_at_most(kMostPerVertex * input_limits().vertices, total_.uvs, "texture coordinates");
    require_at_most(kMostPerVertex * input_limits().vertices, total_.normals, "normals");
    require_at_most(input_limits().faces, total_.faces, "faces");
    scan_.positions.resize(static_cast<Index>(total_.vertices), 3);
    scan_.uvs.resize(static_cast<Index>(total_.uvs), 2);
    for_each_line([&](std::string_view line) { check(line); });
    if (total_.vertices == 0) {
      throw InvalidInput(concat(name_, ": expected a mesh, found no vertex ('v' line)"));
    }
    if (scan_.face_count == 0) {
      throw InvalidInput(concat(name_, ": expected a mesh, found no face ('f' line)"));
    }
    return std::move(scan_);
  }

 private:
  template <class Visit>
  void for_each_line(const Visit& visit) {
    line_number_ = 0;
    for (std::size_t begin = 0; begin < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', begin), text_.size());
      std::string_view line = text_.substr(begin, end - begin);
      if (line.ends_with('\r')) line.remove_suffix(1);
      ++line_number_;
      visit(line);
      begin = end + 1;
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput(concat(name_, ":", std::max<std::size_t>(line_number_, 1), ": ", what));
  }

  void require_at_most(std::uint64_t most, std::uint64_t found, std::string_view what) const {
    if (found <= most) return;
    throw InvalidInput(
        concat(name_, ": expected at most ", most, ' ', what, " (--limit), found ", found));
  }

  /// First pass: how many of each there are, so that indices can be checked as they come.
  void count(std::string_view line) {
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    if (line.size() >= 2 && line[0] == 'f' && is_blank(line[1])) ++total_.faces;
    if (line.size() < 2 || line[0] != 'v') return;
    if (is_blank(line[1])) ++total_.vertices;
    if (line.size() < 3 || !is_blank(line[2])) return;
    if (line[1] == 't') ++total_.uvs;
    if (line[1] == 'n') ++total_.normals;
  }

  void check(std::string_view line) {
    split(line, words_);
    if (words_.empty() || words_[0].starts_with('#')) return;
    const std::string_view statement = words_[0];
    if (line.ends_with('\\')) fail("expected a whole statement, found one continued with '\\'");
    if (line.find('\r') != line.npos) {
      fail("expected lines that end in LF or CR LF, found a lone CR");
    }
    if (line.find('\0') != line.npos) fail("expected text, found a NUL byte");
    if (statement == "f") return face();
    if (statement == "v") return vertex();
    if (statement == "vt") return texture_coordinate();
    if (statement == "vn") return normal();
    if (statement == "usemtl") {
      scan_.materials.push_back({name_after(line, statement), scan_.face_count});
    } else if (statement == "g" || statement == "o") {
      scan_.groups.push_back({name_after(line, statement), scan_.face_count});
    } else if (statement == "mtllib") {
      scan_.material_libraries.push_back(name_after(line, statement));
    } else if (std::ranges::find(kOtherStatements, statement) == kOtherStatements.end()) {
      fail(concat("expected an OBJ statement, found ", quoted(statement)));
    }
  }

  std::string name_after(std::string_view line, std::string_view statement) const {
    const std::string_view name = rest_after(line, statement);
    if (name.size() > kLongestName) {
      fail(concat("expected a name of at most ", kLongestName, " bytes, found ", name.size()));
    }
    return std::string(name);
  }

  double number(std::string_view word, double largest) const {
    const auto value = parse_double(word);
    if (!value) fail(concat("expected a finite number, found ", quoted(word)));
    if (std::abs(*value) > largest) {
      fail(concat("expected a coordinate within ±", largest, ", found ", quoted(word)));
    }
    return *value;
  }

  void require_words(std::size_t least, std::size_t most, std::string_view what) const {
    const std::size_t found = words_.size() - 1;
    if (found < least || found > most) {
      fail(concat("expected ", what, ", found ", found, found == 1 ? " word" : " words"));
    }
  }

  void vertex() {
    require_words(3, 8, "3 coordinates (and at most w and a colour)");
    const auto row = static_cast<Index>(seen_.vertices++);
    for (std::size_t c = 0; c < 3; ++c) {
      scan_.positions(row, static_cast<Index>(c)) = number(words_[c + 1], kLargestCoordinate);
    }
    for (std::size_t c = 4; c < words_.size(); ++c) number(words_[c], kLargestCoordinate);
  }

  void texture_coordinate() {
    require_words(1, 3, "2 texture coordinates (and at most w)");
    const auto row = static_cast<Index>(seen_.uvs++);
    for (std::size_t c = 1; c < words_.size(); ++c) {
      const double value = number(words_[c], kLargestCoordinate);
      if (c <= 2) scan_.uvs(row, static_cast<Index>(c) - 1) = value;
    }
    if (words_.size() == 2) scan_.uvs(row, 1) = 0;
  }

  void normal() {
    require_words(3, 3, "3 components of a normal");
    for (std::size_t c = 1; c < 4; ++c) number(words_[c], kLargestCoordinate);
    ++seen_.normals;
  }

  /// A 1-based or relative index, checked against what exists (or, relative, what came before).
  void check_index(std::string_view digits, std::string_view what, std::uint64_t total,
                   std::uint64_t so_far) const {
    const bool relative = digits.starts_with('-');
    const auto value = parse_unsigned(relative ? digits.substr(1) : digits);
    if (!value) fail(concat("expected the number of a ", what, ", found ", quoted(digits)));
    const std::uint64_t available = relative ? so_far : total;
    if (*value == 0 || *value > available) {
      fail(concat("expected a ", what, " between ", relative ? "-" : "", 1, " and ",
                  relative ? "-" : "", available, ", found ", quoted(digits)));
    }
  }

  void face() {
    if (words_.size() < 4) {
      fail(concat("expected a face of at least 3 corners, found ", words_.size() - 1));
    }
    if (words_.size() - 1 > kMostCorners) {
      fail(concat("expected a face of at most ", kMostCorners, " corners, found ",
                  words_.size() - 1));
    }
    int form = -1;
    for (std::size_t c = 1; c < words_.size(); ++c) {
      const int this_form = corner(words_[c]);
      if (form >= 0 && this_form != form) {
        fail(concat("expected all corners of the face like the first, found ", quoted(words_[c])));
      }
      form = this_form;
    }
    ++scan_.face_count;
    scan_.corner_count += static_cast<Index>(words_.size()) - 1;
  }

  /// v, v/vt, v//vn or v/vt/vn. \return which of the four, as bits: 1 texture, 2 normal.
  int corner(std::string_view word) const {
    const std::size_t first = word.find('/');
    const std::size_t second = first == word.npos ? word.npos : word.find('/', first + 1);
    check_index(word.substr(0, first), "vertex", total_.vertices, seen_.vertices);
    if (first == word.npos) return 0;
    const bool has_normal = second != word.npos;
    const std::string_view uv = word.substr(first + 1, has_normal ? second - first - 1 : word.npos);
    int form = 0;
    if (!uv.empty() || !has_normal) {
      check_index(uv, "texture coordinate", total_.uvs, seen_.uvs);
      form |= 1;
    }
    if (has_normal) {
      check_index(word.substr(second + 1), "normal", total_.normals, seen_.normals);
      form |= 2;
    }
    return form;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t line_number_ = 0;
  std::vector<std::string_view> words_;
  Counts total_, seen_;  ///< in the whole text, and in the lines checked so far
  ObjScan scan_;
};

}  // namespace

ObjScan scan_obj(std::string_view text, const std::string& name) {
  return Scanner(text, name).run();
}

}  // namespace crowdface
