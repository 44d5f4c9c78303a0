// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_mend.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "crowdface/core/text.h"
#include "crowdface/io/obj_statements.h"

namespace crowdface {
namespace {

/// The three indices of a corner as text; a missing index is an empty text.
struct CornerWords {
  std::array<std::string_view, 3> words;
  explicit CornerWords(std::string_view corner) {
    for (std::string_view& word : words) {
      const auto slash = std::ranges::find(corner, '/');
      word = {corner.begin(), slash};
      corner = {slash == corner.end() ? slash : slash + 1, corner.end()};
    }
  }
};

class Mender {
 public:
  std::optional<MendedObj> mend(std::string_view text) {
    ends_within_line_ = !text.ends_with('\n') && !text.ends_with('\r');
    join_lines(text);
    count();
    std::string out;
    out.reserve(text_.size());
    for (std::size_t at = 0; at < text_.size();) {
      std::string_view line = next_obj_line(text_, at);
      const bool has_cr = line.ends_with('\r');
      if (has_cr) line.remove_suffix(1);
      add(line, out);
      if (has_cr) out += '\r';
      if (at <= text_.size()) out += '\n';
    }
    if (out == text) return std::nullopt;
    return MendedObj{std::move(out), notes()};
  }

 private:
  void join_lines(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    // Some versions of ZBrush end a file with a NUL byte. Old DOS programs end it with 0x1A.
    const std::size_t end = text.find_last_not_of(std::string_view("\0\x1a\r\n\t ", 6)) + 1;
    text = text.substr(0, text.find_first_of(std::string_view("\0\x1a", 2), end));
    std::string plain;  // text with lines that end in LF or CR LF
    if (text.find('\r') != text.npos) {
      plain.reserve(text.size());
      for (std::size_t i = 0; i < text.size(); ++i) {
        const bool lone = text[i] == '\r' && i + 1 < text.size() && text[i + 1] != '\n';
        if (!lone) plain += text[i];
        if (lone && text[i + 1] != '\r') plain += '\n';
      }
      text = plain;
    }
    const std::string lower = with_lower_case_statements(text);
    text = lower;
    text_.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
      std::string_view line = next_obj_line(text, at);
      std::size_t joined = 0;
      while (is_continued(text, without_cr(line)) && at < text.size()) {
        line = without_cr(line);
        text_ += line.substr(0, line.size() - 1);
        text_ += ' ';
        line = next_obj_line(text, at);
        ++joined;
      }
      text_ += line;
      if (at <= text.size()) text_ += '\n';
      text_.append(joined, '\n');
    }
  }
  static std::string with_lower_case_statements(std::string_view text) {
    std::string result(text);
    for (std::size_t at = 0; at < text.size();) {
      const std::string_view word = first_obj_word(next_obj_line(text, at));
      const std::string lower = lower_case(word);
      if (!is_obj_statement(lower)) continue;
      std::ranges::copy(lower, result.begin() + (word.data() - text.data()));
    }
    return result;
  }
  static std::string_view without_cr(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  /// Counts the `vn` lines, finds invalid `vt` lines, and checks whether the normals of all corners
  /// are valid.
  void count() {
    std::uint64_t normals_so_far = 0;
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t at = 0; at < text_.size();) {
        const std::string_view line = next_obj_line(text_, at);
        const std::string_view statement = first_obj_word(line);
        if (pass == 0) {
          if (statement == "vt") bad_uvs_.push_back(!are_numbers(line, 1, 2));
          if (statement == "vn") ++normals_;
        } else if (statement == "vn") {
          ++normals_so_far;
        } else if (is_face(statement) && !drops_normals_) {
          std::size_t named = 0, corners = 0;
          for (const std::string_view word : words_after(line)) {
            const CornerWords corner(word);
            ++corners;
            if (std::ranges::count(word, '/') < 2) continue;
            ++named;
            if (!row_of(corner.words[2], normals_, normals_so_far)) drops_normals_ = true;
          }
          if (named != 0 && named != corners) drops_normals_ = true;
        }
      }
    }
  }

  static bool is_face(std::string_view statement) { return statement == "f" || statement == "fo"; }

  /// The words of a line after its first word (the statement), without a trailing comment.
  static std::vector<std::string_view> words_after(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0;;) {
      at = std::min(line.find_first_not_of(kObjBlanks, at), line.size());
      if (at == line.size() || line[at] == '#') break;
      const std::size_t end = std::min(line.find_first_of(kObjBlanks, at), line.size());
      words.push_back(line.substr(at, end - at));
      at = end;
    }
    if (!words.empty()) words.erase(words.begin());
    return words;
  }

  static bool are_numbers(std::string_view line, std::size_t least, std::size_t most) {
    const auto words = words_after(line);
    if (words.size() < least) return false;
    return std::all_of(words.begin(),
                       words.begin() + static_cast<std::ptrdiff_t>(std::min(most, words.size())),
                       [](std::string_view word) { return parse_double(word).has_value(); });
  }

  /// The row that an OBJ index refers to; nothing if there is no such row.
  static std::optional<std::uint64_t> row_of(std::string_view word, std::uint64_t total,
                                             std::uint64_t so_far) {
    const bool relative = word.starts_with('-');
    const auto value = parse_unsigned(relative ? word.substr(1) : word);
    if (!value || *value == 0 || *value > (relative ? so_far : total)) return std::nullopt;
    return relative ? so_far - *value : *value - 1;
  }

  void add(std::string_view line, std::string& out) {
    const std::string_view statement = first_obj_word(line);
    if (is_face(statement)) return add_face(line, out);
    if (statement == "v") {
      const auto words = words_after(line);
      constexpr std::size_t kMax = 8;  // x y z, w, and a colour
      const bool colours = words.size() > 3 && words.size() <= kMax && are_numbers(line, 4, kMax);
      lost_colours_ += words.size() > 3 && !colours ? 1U : 0U;
      return add_words("v", words, colours ? kMax : 3, line, out);
    }
    if (statement == "vt") {
      const bool bad = bad_uvs_[uvs_so_far_++];
      if (bad) {
        out += "vt 0 0";
        return;
      }
      return add_words("vt", words_after(line), are_numbers(line, 3, 3) ? 3 : 2, line, out);
    }
    if (statement == "vn") {
      if (drops_normals_) return;
      if (are_numbers(line, 3, 3)) return add_words("vn", words_after(line), 3, line, out);
      ++bad_normals_;
      out += "vn 0 0 1";
      return;
    }
    out += line;
  }

  /// Appends a line of the file to `out`: its keyword and at most `most` of the words after the
  /// keyword. Drops further words and comments. If there is nothing to drop, appends the line
  /// unchanged.
  static void add_words(std::string_view keyword, const std::vector<std::string_view>& words,
                        std::size_t most, std::string_view line, std::string& out) {
    const bool is_sound = words.size() <= most && line.find('#') == line.npos;
    if (is_sound) {
      out += line;
      return;
    }
    out += keyword;
    for (std::size_t i = 0; i < std::min(most, words.size()); ++i) {
      out += ' ';
      out += words[i];
    }
  }

  void add_face(std::string_view line, std::string& out) {
    const auto words = words_after(line);
    constexpr std::size_t kMinCorners = 3;
    if (words.size() < kMinCorners) {
      ++small_faces_;
      return;
    }
    std::size_t good = 0, named = 0, dangling = 0;
    bool has_normals = false, is_foreign = false;
    for (const std::string_view word : words) {
      const CornerWords corner(word);
      is_foreign = is_foreign || std::ranges::count(word, '/') > 2;
      has_normals = has_normals || std::ranges::count(word, '/') > 1;
      dangling += word.ends_with('/') ? 1U : 0U;
      if (corner.words[1].empty()) continue;
      ++named;
      const auto row = row_of(corner.words[1], bad_uvs_.size(), uvs_so_far_);
      good += row && !bad_uvs_[*row] ? 1U : 0U;
    }
    const bool lacks_uvs = named > 0 && good < words.size();
    lost_uvs_ += lacks_uvs ? 1U : 0U;
    const bool is_plain = first_obj_word(line) == "f" && line.find('#') == line.npos;
    if (is_foreign ||
        (is_plain && !lacks_uvs && dangling == 0 && !(has_normals && drops_normals_))) {
      out += line;
      return;
    }
    out += 'f';
    for (const std::string_view word : words) {
      const CornerWords corner(word);
      out += ' ';
      out += corner.words[0];
      const bool uv = !lacks_uvs && named > 0, normal = has_normals && !drops_normals_;
      if (uv || normal) out += '/';
      if (uv) out += corner.words[1];
      if (!normal) continue;
      out += '/';
      out += corner.words[2];
    }
  }

  std::vector<std::string> notes() const {
    std::vector<std::string> notes;
    if (drops_normals_) {
      notes.emplace_back(
          "its faces refer to normals that do not exist (the third number of f lines): the normals "
          "are computed from the surface instead");
    }
    if (bad_normals_ > 0) {
      notes.push_back(concat(
          bad_normals_,
          " of its normals are not numbers: the normals are computed from the surface instead"));
    }
    if (lost_uvs_ > 0) {
      notes.push_back(concat(lost_uvs_,
                             " of its faces have texture coordinates that do not exist, are not "
                             "numbers, or are missing at some corners: these faces get none"));
    }
    if (small_faces_ > 0) {
      notes.push_back(
          concat(small_faces_, " of its faces have fewer than 3 corners and are left out"));
    }
    if (ends_within_line_ && lost_uvs_ + small_faces_ > 0) {
      notes.emplace_back("the file ends within a line: if it is cut off, copy or export it again");
    }
    if (lost_colours_ > 0) {
      notes.push_back(
          concat(lost_colours_,
                 " of its vertices have colours that are not numbers: these colours are ignored"));
    }
    return notes;
  }

  std::string text_;  ///< the text to repair, with one statement per line
  std::vector<bool> bad_uvs_;
  std::uint64_t normals_ = 0, uvs_so_far_ = 0;
  bool drops_normals_ = false, ends_within_line_ = false;
  std::size_t bad_normals_ = 0, lost_uvs_ = 0, small_faces_ = 0, lost_colours_ = 0;
};

}  // namespace

std::optional<MendedObj> mend_obj(std::string_view text) {
  return Mender().mend(text);
}

}  // namespace crowdface
