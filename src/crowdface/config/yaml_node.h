// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// Where a piece of a config stands: in a file, or (line 0) on the command line.
struct YamlPlace {
  std::shared_ptr<const std::string> source;  ///< file name, or the option as it was given
  int line = 0;                               ///< from 1
  int column = 0;                             ///< from 1, counted in characters, not bytes
  /// "file:line:column", or the option.
  std::string text() const;
};

struct YamlEntry;

/// A checked YAML tree: plain data, no anchors, aliases, tags or duplicate keys, every node with
/// its place. (yaml-cpp's own nodes let the first of two equal keys win and read 010 as 8.)
struct YamlNode {
  enum class Kind {
    kNothing,  ///< no value, `~` or `null`
    kScalar,
    kList,
    kMap,
    kRefused,  ///< a complaint was made of it already
  };
  Kind kind = Kind::kNothing;
  YamlPlace place;
  std::string
      path;  ///< the keys that lead here, "crowd.count"; list items count from 1: "recipes #2"
  std::string text;                ///< kScalar, as written
  bool quoted = false;             ///< kScalar: between quotes, so text and never a number
  std::vector<YamlNode> items;     ///< kList
  std::vector<YamlEntry> entries;  ///< kMap, in the order of the file

  const YamlEntry* find(std::string_view key) const;
};

struct YamlEntry {
  std::string key;
  YamlPlace key_place;
  YamlNode value;
};

/// What is found, in words for a message: "a mapping", "a list of 3", the text in quotes.
std::string describe(const YamlNode& node);

}  // namespace crowdface
