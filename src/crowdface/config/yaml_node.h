// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// The location of a config value: in a file, or (line 0) on the command line.
struct YamlPlace {
  std::shared_ptr<const std::string> source;  ///< file name, or the option as the user typed it
  int line = 0;                               ///< from 1; 0: command line or whole file
  int column = 0;                             ///< from 1, in characters, not bytes
  /// Returns "file:line:column", or `source` alone if line is 0.
  std::string text() const;
};

struct YamlEntry;

/// A checked YAML tree without anchors, aliases, tags or duplicate keys. Every node has its
/// location. (yaml-cpp's own nodes silently keep the first of two equal keys and read 010 as 8.)
struct YamlNode {
  enum class Kind {
    kNothing,  ///< no value, `~` or `null`
    kScalar,
    kList,
    kMap,
    kRefused,  ///< not usable; a complaint about the node exists
  };
  Kind kind = Kind::kNothing;
  YamlPlace place;
  std::string path;  ///< keys from the root, "crowd.count"; list items count from 1: "recipes #2"
  std::string text;  ///< kScalar: the value as written
  bool quoted = false;             ///< kScalar: in quotes, hence text and never a number
  std::vector<YamlNode> items;     ///< kList
  std::vector<YamlEntry> entries;  ///< kMap, in the order of the file

  /// Returns the entry with this key, or null.
  const YamlEntry* find(std::string_view key) const;
};

struct YamlEntry {
  std::string key;
  YamlPlace key_place;
  YamlNode value;
};

/// Describes a node for a message: "a mapping", "a list of 3", or the text in quotes.
std::string describe(const YamlNode& node);

}  // namespace crowdface
