// SPDX-License-Identifier: Apache-2.0
#include "crowdface/page/http_head.h"

#include <algorithm>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

bool is_token(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  });
}

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

}  // namespace

std::size_t HttpHead::count(std::string_view name) const {
  return static_cast<std::size_t>(std::ranges::count(
      fields, name, [](const auto& field) { return std::string_view(field.first); }));
}

std::string_view HttpHead::value(std::string_view name) const {
  for (const auto& [key, value] : fields) {
    if (key == name) return value;
  }
  return {};
}

std::optional<HttpHead> parse_http_head(std::string_view text) {
  HttpHead head;
  for (bool is_first = true; !text.empty(); is_first = false) {
    const std::size_t end = text.find("\r\n");
    if (end == text.npos) return std::nullopt;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 2);
    if (line.empty()) return is_first || !text.empty() ? std::nullopt : std::optional(head);
    if (is_first) {
      const std::size_t method = line.find(' '), version = line.rfind(' ');
      if (method == line.npos || version == method) return std::nullopt;
      head.method = line.substr(0, method);
      const std::string_view protocol = line.substr(version + 1);
      const std::string_view target = line.substr(method + 1, version - method - 1);
      auto path = percent_decoded(target.substr(0, target.find('?')));
      if (!is_token(head.method) || !path || target.find(' ') != target.npos ||
          std::ranges::any_of(*path, is_control)) {
        return std::nullopt;
      }
      if (protocol != "HTTP/1.1" && protocol != "HTTP/1.0") return std::nullopt;
      head.path = std::move(*path);
      head.closes_connection = protocol == "HTTP/1.0";
      continue;
    }
    const std::size_t colon = line.find(':');
    if (colon == line.npos || !is_token(line.substr(0, colon))) return std::nullopt;
    const std::string_view value = trimmed(line.substr(colon + 1));
    if (std::ranges::any_of(value, [](char c) { return c != '\t' && is_control(c); })) {
      return std::nullopt;
    }
    head.fields.emplace_back(lower_case(line.substr(0, colon)), value);
    if (head.fields.back().first == "connection" && lower_case(value) == "close") {
      head.closes_connection = true;
    }
  }
  return std::nullopt;
}

}  // namespace crowdface
