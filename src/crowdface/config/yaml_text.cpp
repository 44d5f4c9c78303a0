// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/yaml_text.h"

#include <algorithm>

#include "crowdface/core/input_limits.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

bool is_utf16(std::string_view text) {
  return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
}

/// Returns whether the text starts with a control character, other than a tab, '\n' or "\r\n".
bool is_control(std::string_view text) {
  const auto c = static_cast<unsigned char>(text[0]);
  if (c == '\r') return text.size() < 2 || text[1] != '\n';
  return c == 0x7f || (c < 0x20 && c != '\t' && c != '\n');
}

/// Returns the offset of the first tab in the indentation of a line; npos if there is no such tab.
/// Ignores blank lines and comments.
std::size_t find_indenting_tab(std::string_view line) {
  const std::size_t text = line.find_first_not_of(" \t\r\n");
  if (text == std::string_view::npos || line[text] == '#') return std::string_view::npos;
  return line.substr(0, text).find('\t');
}

/// If the text starts with a blank that is not a space, such as the no-break space of a word
/// processor, returns the number of bytes of this blank. Otherwise returns 0. YAML treats such a
/// blank as a letter.
std::size_t other_blank_length(std::string_view text) {
  for (const std::string_view blank :
       {"\u00a0", "\u2000", "\u2001", "\u2002", "\u2003", "\u2004", "\u2005", "\u2006", "\u2007",
        "\u2008", "\u2009", "\u200a", "\u200b", "\u202f", "\u205f", "\u3000", "\ufeff"}) {
    if (text.starts_with(blank)) return blank.size();
  }
  return 0;
}

/// Returns the offset of the first blank that is not a space (see other_blank_length) but stands
/// where YAML needs a space: at the start or the end of a line, or beside ':'. Returns npos if
/// there is none. Ignores comments and quoted text. Inside names, such blanks are allowed.
std::size_t find_other_blank(std::string_view line) {
  char quote = '\0';
  bool is_after_space = true, needs_space = true;
  std::size_t blank = line.npos;  // offset of the first other blank since the last letter
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    const std::size_t length = other_blank_length(line.substr(at));
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (length > 0) {
      if (needs_space) return at;
      blank = std::min(blank, at);
      at += length - 1;
    } else if (c == '#' && is_after_space) {
      break;
    } else if (c == ':' && blank != line.npos) {
      return blank;
    } else if (c != ' ' && c != '\t' && c != '\r' && c != '\n') {
      if (needs_space && (c == '"' || c == '\'')) quote = c;
      needs_space = c == ':' || (c == '-' && needs_space) || c == '[' || c == '{' || c == ',';
      blank = line.npos;
    }
    is_after_space = c == ' ' || c == '\t';
  }
  return quote == '\0' ? blank : line.npos;
}

}  // namespace

YamlText::YamlText(std::string_view text, const std::string& source)
    : text_(text), source_(std::make_shared<const std::string>(source)), line_starts_{0} {
  if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
    if (is_utf8_continuation(text_[i])) continuation_byte_offsets_.push_back(i);
  }
}

std::string_view YamlText::text_at_position(int line, int byte_column) const {
  const auto row = std::min(static_cast<std::size_t>(std::max(line, 0)), line_starts_.size() - 1);
  const auto column = static_cast<std::size_t>(std::max(byte_column, 0));
  return text_.substr(std::min(line_starts_[row] + column, text_.size()));
}

YamlPlace YamlText::place_of(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(line_starts_, offset);
  const std::size_t line_start = *(next - 1);
  const auto count_to = [&](std::size_t end) {
    return std::ranges::lower_bound(continuation_byte_offsets_, end) -
           continuation_byte_offsets_.begin();
  };
  const auto bytes = static_cast<std::ptrdiff_t>(offset - line_start);
  const auto characters = bytes - (count_to(offset) - count_to(line_start));
  return {source_, static_cast<int>(next - line_starts_.begin()), static_cast<int>(characters) + 1};
}

YamlPlace YamlText::place(int line, int byte_column) const {
  return place_of(text_.size() - text_at_position(line, byte_column).size());
}

std::optional<YamlText::Problem> YamlText::find_problem() const {
  if (const std::uint64_t most = input_limits().yaml_bytes; text_.size() > most) {
    constexpr std::uint64_t kMiB = 1U << 20U;
    return Problem{place_of(0),
                   concat("more than ", most % kMiB == 0 ? most / kMiB : most,
                          most % kMiB == 0 ? " MiB" : " bytes",
                          " (--limit yaml_bytes=NUMBER allows more); is this a config file?")};
  }
  if (is_utf16(text_)) {
    return Problem{place_of(0), "expected UTF-8 text, found UTF-16; save the file as UTF-8"};
  }
  // Decode the text character by character.
  for (std::size_t at = 0; at < text_.size();) {
    const std::string_view rest = text_.substr(at);
    const std::size_t length = utf8_length(rest);
    if (length == 0) {
      return Problem{place_of(at),
                     "expected UTF-8 text, found a byte that is not UTF-8; save the file as UTF-8"};
    }
    if (is_control(rest)) {
      return Problem{place_of(at), concat("a control character, ", quoted(rest.substr(0, 1)),
                                          ", is not allowed in a config; save the file as UTF-8 "
                                          "text")};
    }
    at += length;
  }
  // Search each line for tabs in the indentation, and for blanks that are not spaces. JSON may
  // contain both.
  const std::size_t first = text_.find_first_not_of(" \t\r\n");
  const bool is_json = first != text_.npos && (text_[first] == '{' || text_[first] == '[');
  if (is_json) return std::nullopt;
  for (std::size_t row = 0; row < line_starts_.size(); ++row) {
    const std::size_t end = row + 1 < line_starts_.size() ? line_starts_[row + 1] : text_.size();
    const std::string_view line = text_.substr(line_starts_[row], end - line_starts_[row]);
    const std::size_t tab = find_indenting_tab(line);
    if (tab != std::string_view::npos) {
      return Problem{place_of(line_starts_[row] + tab), "a tab in the indentation; use spaces"};
    }
    const std::size_t blank = find_other_blank(line);
    if (blank != std::string_view::npos) {
      return Problem{place_of(line_starts_[row] + blank),
                     "a no-break space or another special blank; replace it by a plain space"};
    }
  }
  return std::nullopt;
}

bool YamlText::is_null_at(int line, int byte_column) const {
  const std::string_view rest = text_at_position(line, byte_column);
  return rest.starts_with('~') || rest.starts_with("null") || rest.starts_with("Null") ||
         rest.starts_with("NULL");
}

bool YamlText::is_unclosed_quote_at(int line, int byte_column) const {
  const std::string_view rest = text_at_position(line, byte_column);
  if (!rest.starts_with('\'') && !rest.starts_with('"')) return false;
  const char quote = rest[0];
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (quote == '"' && rest[i] == '\\') {
      ++i;
    } else if (rest[i] == quote) {
      if (quote == '"' || i + 1 >= rest.size() || rest[i + 1] != '\'') return false;
      ++i;  // inside single quotes, '' is one quote character
    }
  }
  return true;
}

}  // namespace crowdface
