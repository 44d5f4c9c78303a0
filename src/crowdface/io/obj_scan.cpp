// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crowdface/core/error.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/text.h"
#include "crowdface/io/foreign_file.h"
#include "crowdface/io/obj_statements.h"

namespace crowdface {
namespace {

constexpr std::uint64_t kMaxPerVertex = 8;
// Maximum length in bytes of a material name, a group name, or a list of material files.
constexpr std::size_t kLongestObjName = 1000;
// `scan_obj` rejects larger coordinates, because adjacent single-precision numbers beyond this size
// differ by a whole unit or more.
constexpr double kLargestCoordinate = 1e7;

/// Splits a line into words without copying.
void split_words(std::string_view line, std::vector<std::string_view>& words) {
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

/// Returns the next line without its line end; see next_obj_line.
std::string_view next_line(std::string_view text, std::size_t& at) {
  std::string_view line = next_obj_line(text, at);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view without_blanks_before(std::string_view line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  return line;
}

/// Whether a line begins with this statement. The line must have no leading blanks.
bool is_of(std::string_view line, std::string_view statement) {
  return line.size() > statement.size() && line.starts_with(statement) &&
         is_blank(line[statement.size()]);
}

/// Counts the lines of each kind, so that a later single pass can check the indices. Also computes
/// the hash `ObjSummary::mesh_digest`.
class Summariser {
 public:
  void look_at(std::string_view whole_line) {
    const std::string_view line = without_blanks_before(whole_line);
    if (line.empty() || line[0] == '#') return;
    if (is_of(line, "v")) {
      ++summary_.vertex_count;
      return;
    }
    if (is_of(line, "vn")) {
      ++summary_.normal_count;
      return;
    }
    for (const std::string_view statement : {"g", "o", "usemtl", "mtllib"}) {
      if (!is_of(line, statement)) continue;
      add_run();
      hash_counts();
      hasher_.add(statement);
      return;
    }
    if (is_of(line, "f")) ++summary_.face_count;
    if (is_of(line, "vt")) ++summary_.uv_count;
    take(whole_line);
  }
  ObjSummary end() {
    add_run();
    hash_counts();
    summary_.mesh_digest = hasher_.digest();
    return summary_;
  }

 private:
  /// Adds a line to the hash. Consecutive lines are hashed as one text.
  void take(std::string_view line) {
    constexpr std::ptrdiff_t kLongestEnd = 2;  // CR LF
    const std::ptrdiff_t gap = run_.empty() ? -1 : line.data() - (run_.data() + run_.size());
    if (gap > 0 && gap <= kLongestEnd) {
      run_ = {run_.data(), run_.size() + static_cast<std::size_t>(gap) + line.size()};
      return;
    }
    add_run();
    hash_counts();
    run_ = line;
  }
  void add_run() {
    if (!run_.empty()) hasher_.add(run_);
    run_ = {};
  }
  /// Adds to the hash the numbers of vertices and normals before the current line, because relative
  /// indices count backwards from these numbers.
  void hash_counts() { hasher_.add(summary_.vertex_count).add(summary_.normal_count); }

  ObjSummary summary_;
  Hasher hasher_;
  std::string_view run_;
};

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& name, const ObjSummary& summary,
          ObjLineSelection line_selection)
      : text_(text), name_(name), line_selection_(line_selection), total_(summary) {}

  ObjScan run() {
    if (text_.starts_with("\xEF\xBB\xBF")) {
      fail("expected plain text, found a byte-order mark; save the file as UTF-8 without BOM");
    }
    require_at_most(input_limits().vertices, total_.vertex_count, "vertices");
    // A vertex may have several texture coordinates and normals, so their limits are kMaxPerVertex
    // times the limit of vertices.
    require_at_most(kMaxPerVertex * input_limits().vertices, total_.uv_count,
                    "texture coordinates");
    require_at_most(kMaxPerVertex * input_limits().vertices, total_.normal_count, "normals");
    require_at_most(input_limits().faces, total_.face_count, "faces");
    scan_.positions.resize(static_cast<Index>(total_.vertex_count), 3);
    scan_.uvs.resize(
        line_selection_ == ObjLineSelection::kAll ? static_cast<Index>(total_.uv_count) : 0, 2);
    for (std::size_t at = 0; at < text_.size();) {
      const std::string_view line = next_line(text_, at);
      ++line_number_;
      in_cut_line_ = line.data() + line.size() == text_.data() + text_.size();
      if (line_selection_ == ObjLineSelection::kAll || !skips(line)) check(line);
    }
    in_cut_line_ = false;
    if (total_.vertex_count == 0 && first_unknown_line_ != 0) {
      line_number_ = first_unknown_line_;
      fail(concat("expected an OBJ statement, found ", quoted(first_unknown_)));
    }
    if (total_.vertex_count == 0) {
      throw InvalidInput(concat(name_, ": expected a mesh, found no vertex ('v' line)"));
    }
    if (scan_.face_count == 0) {
      throw InvalidInput(concat(name_, ": expected a mesh, found no face ('f' line)"));
    }
    return std::move(scan_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InvalidInput(
        concat(name_, ":", std::max<std::size_t>(line_number_, 1), ": ", what,
               in_cut_line_ ? "; the file ends within this line: copy or export it again" : ""));
  }

  void require_at_most(std::uint64_t most, std::uint64_t found, std::string_view what) const {
    if (found <= most) return;
    throw InvalidInput(
        concat(name_, ": expected at most ", most, ' ', what, " (--limit), found ", found));
  }

  /// Whether a line is a `vt` or `f` line, which the check can skip because the mesh is known. Also
  /// counts the `f` lines.
  bool skips(std::string_view line) {
    line = without_blanks_before(line);
    if (is_of(line, "vt")) return true;
    if (!is_of(line, "f")) return false;
    ++scan_.face_count;
    return true;
  }

  void check(std::string_view line) {
    split_words(line, words_);
    if (words_.empty() || words_[0].starts_with('#')) return;
    const std::string_view statement = words_[0];
    if (is_continued(text_, line)) {
      fail("expected a whole statement, found one continued with '\\'");
    }
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
    } else if (!is_obj_statement(statement)) {
      unknown_statement(statement);
    }
  }

  /// Handles a statement that OBJ does not define. Programs add such statements; readers ignore
  /// them.
  void unknown_statement(std::string_view statement) {
    const std::string lower = lower_case(statement);
    if (!is_valid_name(lower) || is_obj_statement(lower)) {
      fail(concat("expected an OBJ statement, found ", quoted(statement)));
    }
    if (first_unknown_line_ != 0) return;
    first_unknown_line_ = line_number_;
    first_unknown_ = statement;
    scan_.notes.push_back(concat("unknown OBJ statement ", quoted(statement), " (line ",
                                 line_number_, "): such lines are ignored"));
  }

  std::string name_after(std::string_view line, std::string_view statement) const {
    const std::string_view name = rest_after(line, statement);
    if (name.size() > kLongestObjName) {
      fail(concat("expected a name of at most ", kLongestObjName, " bytes, found ", name.size()));
    }
    return std::string(name);
  }

  double number(std::string_view word, double largest) const {
    const auto value = parse_double(word);
    if (!value)
      fail(concat("expected a finite number, found ", quoted(word), advice_on_bad_number(word)));
    if (std::abs(*value) > largest) {
      fail(concat("expected a coordinate within ±", largest, ", found ", quoted(word),
                  "; move the mesh to the origin before exporting"));
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
    const auto row = static_cast<Index>(seen_.vertex_count++);
    for (std::size_t c = 0; c < 3; ++c) {
      scan_.positions(row, static_cast<Index>(c)) = number(words_[c + 1], kLargestCoordinate);
    }
    for (std::size_t c = 4; c < words_.size(); ++c) number(words_[c], kLargestCoordinate);
  }

  void texture_coordinate() {
    require_words(1, 3, "2 texture coordinates (and at most w)");
    const auto row = static_cast<Index>(seen_.uv_count++);
    for (std::size_t c = 1; c < words_.size(); ++c) {
      const double value = number(words_[c], kLargestCoordinate);
      if (c <= 2) scan_.uvs(row, static_cast<Index>(c) - 1) = value;
    }
    if (words_.size() == 2) scan_.uvs(row, 1) = 0;
  }

  void normal() {
    require_words(3, 3, "3 components of a normal");
    for (std::size_t c = 1; c < 4; ++c) number(words_[c], std::numeric_limits<double>::max());
    ++seen_.normal_count;
  }

  /// Checks a 1-based index against the number of rows, or a relative index (negative) against the
  /// number of rows before this line.
  void check_index(std::string_view digits, std::string_view what, std::uint64_t total,
                   std::uint64_t so_far) const {
    const bool relative = digits.starts_with('-');
    const auto value = parse_unsigned(relative ? digits.substr(1) : digits);
    if (!value) fail(concat("expected the number of a ", what, ", found ", quoted(digits)));
    const std::uint64_t available = relative ? so_far : total;
    if (*value == 0 || *value > available) {
      fail(concat("expected a ", what, " between ", relative ? "-" : "", 1, " and ",
                  relative ? "-" : "", available, ", found ", quoted(digits),
                  *value == 0 ? "; OBJ counts from 1" : ""));
    }
  }

  void face() {
    if (words_.size() < 4) {
      fail(concat("expected a face of at least 3 corners, found ", words_.size() - 1));
    }
    int form = -1;
    for (std::size_t c = 1; c < words_.size(); ++c) {
      const int this_form = corner(words_[c]);
      if (form >= 0 && this_form != form) {
        fail(concat("expected all corners of the face in the form of the first, found ",
                    quoted(words_[c])));
      }
      form = this_form;
    }
    ++scan_.face_count;
    scan_.corner_count += static_cast<Index>(words_.size()) - 1;
  }

  /// Checks a corner: v, v/vt, v//vn or v/vt/vn.
  /// \return the form of the corner as bits: 1 if it has a texture coordinate, plus 2 if it has a
  /// normal.
  int corner(std::string_view word) const {
    const std::size_t first = word.find('/');
    const std::size_t second = first == word.npos ? word.npos : word.find('/', first + 1);
    check_index(word.substr(0, first), "vertex", total_.vertex_count, seen_.vertex_count);
    if (first == word.npos) return 0;
    const bool has_normal = second != word.npos;
    const std::string_view uv = word.substr(first + 1, has_normal ? second - first - 1 : word.npos);
    int form = 0;
    if (!uv.empty() || !has_normal) {
      check_index(uv, "texture coordinate", total_.uv_count, seen_.uv_count);
      form |= 1;
    }
    if (has_normal) {
      check_index(word.substr(second + 1), "normal", total_.normal_count, seen_.normal_count);
      form |= 2;
    }
    return form;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t line_number_ = 0;
  bool in_cut_line_ = false;  ///< whether the current line is the last and has no line end
  std::vector<std::string_view> words_;
  ObjLineSelection line_selection_;
  ObjSummary total_, seen_;  ///< line counts of the whole text, and of the lines checked so far
  ObjScan scan_;
  std::string_view first_unknown_;  ///< first statement that OBJ does not define
  std::size_t first_unknown_line_ = 0;
};

}  // namespace

ObjSummary summarise_obj(std::string_view text) {
  Summariser summariser;
  for (std::size_t at = 0; at < text.size();) summariser.look_at(next_line(text, at));
  return summariser.end();
}

ObjScan scan_obj(std::string_view text, const std::string& name, const ObjSummary& summary,
                 ObjLineSelection line_selection) {
  return Scanner(text, name, summary, line_selection).run();
}

}  // namespace crowdface
