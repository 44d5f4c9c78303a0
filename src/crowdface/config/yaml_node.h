// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// The place where a config value is written: in a file, or on the command line (line 0).
struct YamlPlace {
  std::shared_ptr<const std::string> source;  ///< file name, or the option as the user typed it
  int line = 0;    ///< line number from 1; 0: the place is the command line or the whole file
  int column = 0;  ///< column number from 1, in characters, not in bytes
  /// Returns "file:line:column", or `source` alone if line is 0.
  std::string text() const;
};

struct YamlEntry;

/// A checked YAML tree without anchors, aliases, tags or duplicate keys. Every node has its
/// location. (yaml-cpp's own nodes silently keep the first of two equal keys and read 010 as 8.)
struct YamlNode {
  enum class Kind {
    kNothing,  ///< the node has no value, or the value `~` or `null`
    kScalar,
    kList,
    kMap,
    kRefused,  ///< the node cannot be used; a complaint about it has been added
  };
  Kind kind = Kind::kNothing;
  YamlPlace place;
  /// path of keys from the root, such as "crowd.count"; an item of a list has a number from 1, as
  /// in "recipes #2"
  std::string path;
  std::string text;  ///< kScalar: the value as it is written
  /// kScalar: whether the value is in quotes, so that it is a text and not a number
  bool is_quoted = false;
  std::vector<YamlNode> items;     ///< kList: the items of the list
  std::vector<YamlEntry> entries;  ///< kMap: keys and values, in the order of the file

  /// Returns the entry that has this key; null if there is none.
  const YamlEntry* find(std::string_view key) const;
};

/// A key of a mapping, and the value of the key.
struct YamlEntry {
  std::string key;
  YamlPlace key_place;
  YamlNode value;
};

/// Describes a node for a message: "a mapping", "a list of 3", or the text in quotes.
std::string describe(const YamlNode& node);

}  // namespace crowdface
