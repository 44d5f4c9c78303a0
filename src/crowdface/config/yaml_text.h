// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/yaml_node.h"

namespace crowdface {

/// The characters of a YAML file: finds what yaml-cpp lets through, and tells lines and columns as
/// an editor does. Lines and columns that come in are yaml-cpp's, from 0 and in bytes.
class YamlText {
 public:
  /// \param text  must outlive this object; a byte order mark at its start is skipped.
  YamlText(std::string_view text, const std::string& source);

  std::string_view text() const { return text_; }
  YamlPlace place(int line, int byte_column) const;

  struct Problem {
    YamlPlace place;
    std::string what;
  };
  /// The first byte or line that no YAML file of ours may hold: too long a file, not UTF-8, control
  /// characters, tabs in the indentation.
  std::optional<Problem> find_problem() const;

  /// Whether `~` or `null` is written there (rather than nothing at all).
  bool null_stands_at(int line, int byte_column) const;
  /// Whether a quote starts there that nothing closes; yaml-cpp takes the rest of the file for
  /// text.
  bool quote_left_open(int line, int byte_column) const;

 private:
  std::string_view from(int line, int byte_column) const;
  YamlPlace place_of(std::size_t offset) const;

  std::string_view text_;
  std::shared_ptr<const std::string> source_;
  std::vector<std::size_t> line_starts_;
  std::vector<std::size_t> continuations_;  ///< bytes that continue a character, ascending
};

}  // namespace crowdface
