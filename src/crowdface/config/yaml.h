// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "crowdface/config/complaints.h"

namespace crowdface {

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
