// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/yaml_node.h"

namespace crowdface {

/// The text of a YAML file. Finds problems that yaml-cpp does not report. Also converts yaml-cpp's
/// positions (lines and columns from 0, in bytes) to the positions that text editors show (from 1,
/// in characters).
class YamlText {
 public:
  /// \param text  must outlive this object. If the text starts with a byte order mark, the mark is
  ///              skipped.
  YamlText(std::string_view text, const std::string& source);

  std::string_view text() const { return text_; }
  /// Converts a position that yaml-cpp reports (line and byte column from 0) to a place in the file
  /// (line and column from 1, in characters).
  YamlPlace place(int line, int byte_column) const;

  /// A problem of the text, and the place in the file where the problem is.
  struct Problem {
    YamlPlace place;
    std::string message;
  };
  /// Returns the first of these problems: the file is too long, is not UTF-8, contains a
  /// control character, has a tab in the indentation of a line, or has a no-break space or another
  /// special blank where YAML needs a space.
  std::optional<Problem> find_problem() const;

  /// Returns whether the value at this position is written as `~` or `null`.
  bool is_null_at(int line, int byte_column) const;
  /// Returns whether a quote starts at this position and is never closed. yaml-cpp accepts this,
  /// and takes all of the remaining file as the quoted text.
  bool is_unclosed_quote_at(int line, int byte_column) const;

 private:
  /// Returns the text from a position of yaml-cpp to the end of the file.
  std::string_view text_at_position(int line, int byte_column) const;
  /// Returns the place (line and column) of the byte at this offset in text().
  YamlPlace place_of(std::size_t offset) const;

  std::string_view text_;
  std::shared_ptr<const std::string> source_;
  std::vector<std::size_t> line_starts_;  ///< for each line: offset of its first byte in text()
  /// offsets of UTF-8 continuation bytes, ascending
  std::vector<std::size_t> continuation_byte_offsets_;
};

}  // namespace crowdface
