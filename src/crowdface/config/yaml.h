// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "crowdface/config/complaints.h"

namespace crowdface {

/// Parses one YAML document. Adds a complaint about everything that is not plain YAML: syntax
/// errors, duplicate keys (the second key is refused), anchors and aliases, tags, several
/// documents, text that is neither UTF-8 nor UTF-16 with a byte-order mark, and inputs beyond the
/// limits (100,000 values; by default 1 MiB and 64 levels of nesting, see input_limits).
///
/// \param source  name of the file in messages.
/// \return        the tree without the refused parts; nothing after a syntax error.
std::optional<YamlNode> parse_yaml(std::string_view text, const std::string& source,
                                   Complaints& out);

/// Like parse_yaml, but reads a file. If the file cannot be read, adds a complaint of kind
/// kMissingInput (66).
std::optional<YamlNode> read_yaml(const std::string& file, Complaints& out);

/// Returns the YAML scalar that a reader reads back as this text: without quotes if this is safe,
/// otherwise in quotes.
std::string write_scalar(std::string_view text);

/// Sets one value of the tree, like the option `--set`. Creates mappings on the path to the value
/// where they are missing.
///
/// \param assignment  "key.path=value" with a YAML value, such as "sampling.smoothness=[0.1, 0.5]".
///                    Messages show "--set key.path=value" in place of a line number.
void set_value(YamlNode& root, std::string_view assignment, Complaints& out);

/// Sets one value of the tree to a text, without parsing the text as YAML.
///
/// \param shown_text  what the user typed, for messages: "--count 24".
void set_text(YamlNode& root, std::string_view key_path, std::string_view text,
              const std::string& shown_text, Complaints& out);

}  // namespace crowdface
