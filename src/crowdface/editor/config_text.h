// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/config/yaml_node.h"

namespace crowdface {

/// The lines of a config of which some are replaced; all others stay as they are, comments and order
/// included.
class ConfigText {
 public:
  /// \param source  the file's name, for messages
  /// \throws Error with everything about the text that is not YAML.
  ConfigText(std::string_view text, const std::string& source);

  const YamlNode& root() const { return root_; }
  std::size_t line_count() const { return lines_.size(); }
  /// Without its end.
  const std::string& line(std::size_t i) const { return lines_[i]; }
  /// Where in the text the bracket of a list stands, in bytes; nothing if it has none.
  std::optional<std::size_t> bracket_of(const YamlNode& list) const;
  /// One past the last line that belongs to what begins on line `begin`: what follows is indented by
  /// `indent` or less, or nothing. Comments after it belong to what comes next.
  std::size_t end_of_block(std::size_t begin, std::size_t indent) const;

  /// The whole text with other lines in place of `from` up to `to`.
  std::string with(std::size_t from, std::size_t to, const std::vector<std::string>& others) const;

 private:
  std::vector<std::string> lines_;
  YamlNode root_;
};

/// The line of a place, counted from 0.
std::size_t line_of(const YamlPlace& place);

/// Replaces a config's file if the text reads back well.
/// \throws Error with every problem that the config would have.
void replace_config(const std::filesystem::path& file, const std::string& text);

}  // namespace crowdface
