// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "crowdface/job/complaints.h"

namespace crowdface {

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

/// Reads one YAML document. Complains of everything that is not plain YAML: syntax,
/// duplicate keys (the second is refused), anchors and aliases, tags, several documents, bytes that
/// are no UTF-8, more than 1 MiB, 64 levels or 100,000 values.
/// \param source  the file's name as it is to stand in messages.
/// \return        what could be read; nothing after a syntax error.
std::optional<YamlNode> parse_yaml(std::string_view text, const std::string& source,
                                   Complaints& out);

/// Reads a file the same way. A file that cannot be opened is a complaint of kind 66.
std::optional<YamlNode> read_yaml(const std::string& file, Complaints& out);

/// The text as a YAML scalar that reads back as this text: plain where that is safe, else in
/// quotes.
std::string write_scalar(std::string_view text);

/// Sets one value of the tree, as the command line asks for it. Mappings on the way are made.
/// \param assignment  "key.path=value", the value in YAML, such as "sampling.smoothness=[0.1,
/// 0.5]". Messages show "--set key.path=value" for a place.
void set_value(YamlNode& root, std::string_view assignment, Complaints& out);

/// Sets one value of the tree to this text, whatever it looks like in YAML.
/// \param shown  what the user typed, for messages: "--count 24".
void set_text(YamlNode& root, std::string_view key_path, std::string_view text,
              const std::string& shown, Complaints& out);

}  // namespace crowdface
