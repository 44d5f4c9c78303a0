// SPDX-License-Identifier: Apache-2.0
#include "crowdface/config/config_values.h"

#include <algorithm>

#include "crowdface/core/contains.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

std::string child_path(const YamlNode& map, std::string_view key) {
  return map.path.empty() ? std::string(key) : concat(map.path, '.', key);
}

std::string unknown_key(const YamlNode& map, const std::string& key,
                        const std::vector<std::string>& keys) {
  const std::string where = map.path.empty() ? "" : concat(" in ", map.path);
  const std::string hint = suggestion(key, keys);
  return concat("unknown key ", quoted(key), where,
                hint.empty() ? concat("; expected one of ", join(keys)) : hint);
}

/// Returns the text of a node that must hold a number. Adds a complaint if the number is in quotes
/// or has leading zeros.
std::optional<std::string> number_text(const YamlNode& node, const std::string& expected,
                                       Complaints& out) {
  if (node.kind != YamlNode::Kind::kScalar) return out.add_mismatch(node, expected);
  if (node.is_quoted && parse_double(node.text)) {
    out.add_at(node, concat("expected ", expected, ", found text, ", quoted(node.text),
                            "; leave the quotes out"));
    return std::nullopt;
  }
  const std::size_t first = node.text.find_first_not_of("+-");
  const std::string digits = first == std::string::npos ? "" : node.text.substr(first);
  if (digits.size() > 1 && digits[0] == '0' && digits[1] >= '0' && digits[1] <= '9' &&
      parse_double(digits)) {
    // Suggest the same number without leading zeros: 7 for "007", 0.5 for "00.5".
    std::size_t kept = std::min(digits.find_first_not_of('0'), digits.size() - 1);
    if (digits[kept] < '0' || digits[kept] > '9') --kept;
    out.add_at(node,
               concat("the leading zero of ", node.text, " is ambiguous (YAML 1.1 reads 010 as ",
                      "8); write ", node.text.substr(0, first), digits.substr(kept)));
    return std::nullopt;
  }
  return node.text;
}

/// Indents every line except the first by two spaces.
std::string indented(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '\n' ? "\n  " : std::string(1, c);
  return out;
}

}  // namespace

MapReader::MapReader(const YamlNode& node, const std::vector<std::string>& keys,
                     Complaints& complaints)
    : node_(node), complaints_(complaints) {
  complaints_.expect_map(node_, concat("a mapping with the keys ", join(keys)));
  for (const YamlEntry& entry : node_.entries) {
    if (contains(keys, entry.key)) continue;
    complaints_.add(entry.key_place, unknown_key(node_, entry.key, keys));
  }
}

const YamlNode* MapReader::find(std::string_view key) const {
  const YamlEntry* entry = node_.find(key);
  if (entry == nullptr) return nullptr;
  if (entry->value.kind == YamlNode::Kind::kNothing) {
    complaints_.add_at(entry->value, "no value; write one, or leave the key out");
    return nullptr;
  }
  return &entry->value;
}

const YamlNode* MapReader::require(std::string_view key, std::string_view hint) const {
  if (node_.kind == YamlNode::Kind::kMap && node_.find(key) == nullptr) {
    complaints_.add(node_.place, concat(child_path(node_, key), ": missing; ", hint));
  }
  return find(key);
}

std::optional<double> factor_of_rounded_shares(const std::vector<double>& shares) {
  constexpr double kRounding = 1e-9, kMaxRoundingUp = 0.01;
  double sum = 0, most = 1;
  for (const double share : shares) {
    sum += share;
    if (share > 0) most += kMaxRoundingUp;
  }
  if (sum <= 1 + kRounding) return 1;
  return sum < most - kRounding ? std::optional(1 / sum) : std::nullopt;
}

std::string plain_number(double value) {
  return format_fixed(value, 0);
}

std::optional<double> read_number(const YamlNode& node, double low, double high, Complaints& out) {
  const std::string expected =
      concat("a number from ", plain_number(low), " to ", plain_number(high));
  const auto text = number_text(node, expected, out);
  if (!text) return std::nullopt;
  const auto value = parse_double(*text);
  if (!value || *value < low || *value > high) return out.add_mismatch(node, expected);
  return *value == 0 ? 0.0 : *value;  // turn -0 into 0
}

std::optional<std::uint64_t> read_whole_number(const YamlNode& node, std::uint64_t low,
                                               std::uint64_t high, Complaints& out) {
  const std::string expected = concat("a whole number from ", low, " to ", high);
  const auto text = number_text(node, expected, out);
  if (!text) return std::nullopt;
  const auto value = parse_unsigned(*text);
  if (!value || *value < low || *value > high) return out.add_mismatch(node, expected);
  return value;
}

std::optional<std::string> read_text(const YamlNode& node, const std::string& expected,
                                     Complaints& out) {
  if (node.kind != YamlNode::Kind::kScalar || node.text.empty() ||
      has_control_character(node.text)) {
    return out.add_mismatch(node, expected);
  }
  return node.text;
}

std::optional<std::string> read_name(const YamlNode& node, Complaints& out) {
  if (node.kind != YamlNode::Kind::kScalar || !is_valid_name(node.text)) {
    return out.add_mismatch(
        node, "a name of 1 to 64 letters (a-z), digits, '_', '-' or '.', not starting with '.'");
  }
  return node.text;
}

void expect_one_of(const YamlNode& node, const std::vector<std::string>& words, Complaints& out) {
  const std::string hint =
      node.kind == YamlNode::Kind::kScalar ? suggestion(node.text, words) : std::string();
  out.add_at(node, concat("expected ", join(words, " or "), ", found ", describe(node), hint));
}

void refuse_repeated(const YamlNode& list, Complaints& out) {
  for (auto item = list.items.begin(); item != list.items.end(); ++item) {
    if (std::any_of(list.items.begin(), item, [&](const YamlNode& other) {
          return other.kind == YamlNode::Kind::kScalar && other.text == item->text;
        })) {
      out.add_at(*item, concat(quoted(item->text), " is named twice"));
    }
  }
}

bool is_word(const YamlNode& node, std::string_view word) {
  return node.kind == YamlNode::Kind::kScalar && node.text == word;
}

bool has_control_character(std::string_view text) {
  return std::ranges::any_of(text, [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f;
  });
}

std::string yaml_flow_list(const std::vector<std::string>& items) {
  return concat('[', join(items), ']');
}

std::string yaml_flow_map(const std::vector<std::string>& entries) {
  return concat('{', join(entries), '}');
}

std::string yaml_flow_list_of_names(const std::vector<std::string>& names) {
  return yaml_flow_list(texts_of(names, write_scalar));
}

std::string yaml_block_list(const std::vector<std::string>& items) {
  if (items.empty()) return "[]";
  std::string lines;
  for (const std::string& item : items) {
    const bool one_line = !item.starts_with('\n');
    lines += concat("\n- ", one_line ? item : indented(item).substr(3));
  }
  return lines;
}

std::string yaml_block_map(const std::vector<std::string>& entries) {
  if (entries.empty()) return "{}";
  return concat('\n', join(entries, "\n"));
}

std::string yaml_entry(std::string_view key, std::string_view value) {
  return concat(key, value.starts_with('\n') ? ":" : ": ", indented(value));
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  const auto nearest = nearest_word(word.substr(0, 80), candidates);
  return nearest ? concat("; did you mean ", quoted(*nearest), '?') : std::string();
}

std::string suggestion_or_choices(std::string_view word,
                                  const std::vector<std::string>& candidates) {
  constexpr std::size_t kMaxChoices = 12;
  std::string text = suggestion(word, candidates);
  if (!text.empty() || candidates.empty() || candidates.size() > kMaxChoices) return text;
  return concat("; expected ", candidates.size() > 1 ? "one of " : "", join(candidates));
}

}  // namespace crowdface
