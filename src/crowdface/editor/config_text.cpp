// SPDX-License-Identifier: Apache-2.0
#include "crowdface/editor/config_text.h"

#include <algorithm>

#include "crowdface/config/complaints.h"
#include "crowdface/config/config_reader.h"
#include "crowdface/config/yaml.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/core/utf8.h"

namespace crowdface {
namespace {

YamlNode parsed(std::string_view text, const std::string& source) {
  Complaints complaints;
  auto root = parse_yaml(text, source, complaints);
  Problems problems;
  complaints.tell(problems);
  problems.throw_if_any();
  return std::move(*root);
}

/// Whether nothing but a comment stands there.
bool is_empty(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first == std::string::npos || line[first] == '#';
}

}  // namespace

std::size_t line_of(const YamlPlace& place) {
  return static_cast<std::size_t>(place.line) - 1;
}

ConfigText::ConfigText(std::string_view text, const std::string& source)
    : root_(parsed(text, source)) {
  for (const std::string_view line : split_lines(text)) lines_.emplace_back(line);
}

std::optional<std::size_t> ConfigText::bracket_of(const YamlNode& list) const {
  if (list.kind != YamlNode::Kind::kList) return std::nullopt;
  const std::size_t row = line_of(list.place);
  const std::string& line = lines_[row];
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::size_t at = row == 0 && line.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  for (int column = 1; column < list.place.column && at < line.size(); ++column) {
    do {
      ++at;
    } while (at < line.size() && is_utf8_continuation(line[at]));
  }
  if (at >= line.size() || line[at] != '[') return std::nullopt;
  for (std::size_t i = 0; i < row; ++i) at += lines_[i].size() + 1;
  return at;
}

std::size_t ConfigText::end_of_block(std::size_t begin, std::size_t indent) const {
  std::size_t end = begin + 1;
  for (std::size_t i = end; i < lines_.size(); ++i) {
    if (is_empty(lines_[i])) continue;
    if (lines_[i].find_first_not_of(' ') <= indent) break;
    end = i + 1;
  }
  return end;
}

std::string ConfigText::with(std::size_t from, std::size_t to,
                             const std::vector<std::string>& others) const {
  std::string text;
  for (std::size_t i = 0; i < from; ++i) text += lines_[i] + '\n';
  for (const std::string& line : others) text += line + '\n';
  for (std::size_t i = to; i < lines_.size(); ++i) text += lines_[i] + '\n';
  return text;
}

void replace_config(const std::filesystem::path& file, const std::string& text) {
  // Paths in a config start at its folder, so that it is tried there.
  const std::filesystem::path trial =
      file.parent_path() / concat(".", file.filename().string(), ".edited");
  write_file(trial, text);
  Problems problems;
  read_config(trial, {}, problems);
  remove_if_there(trial);
  problems.throw_if_any();
  write_file(file, text);
}

}  // namespace crowdface
