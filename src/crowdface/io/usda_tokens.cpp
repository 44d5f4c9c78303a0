// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/usda_tokens.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/interrupt.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::string_view kSigns = "()[]{}=,;", kEnds = "()[]{}=,;\"'@<#";

}  // namespace

UsdaTokens::UsdaTokens(std::string_view text, const std::string& name) : text_(text), name_(name) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // byte-order mark
  if (!text_.starts_with("#usda")) {
    fail(
        "expected a USD layer as text, which begins with #usda, found another file: convert it "
        "(usdcat -o head.usda FILE)");
  }
}

void UsdaTokens::fail(std::string_view what) const {
  throw InvalidInput(concat(name_, ": ", what));
}

void UsdaTokens::skip_blanks() {
  while (position_ < text_.size()) {
    if (text_[position_] == '#') {
      position_ = std::min(text_.find('\n', position_), text_.size());
    } else if (static_cast<unsigned char>(text_[position_]) <= ' ') {
      ++position_;
    } else {
      return;
    }
  }
}

std::string_view UsdaTokens::text_before(std::string_view end, bool escapes) {
  const std::size_t begin = position_;
  for (; position_ < text_.size(); ++position_) {
    if (escapes && text_[position_] == '\\') {
      ++position_;
    } else if (text_.substr(position_).starts_with(end)) {
      const std::string_view inside = text_.substr(begin, position_ - begin);
      position_ += end.size();
      return inside;
    }
  }
  fail("it ends within a text or a path");
}

UsdaToken UsdaTokens::next() {
  skip_blanks();
  if (position_ >= text_.size()) return {};
  const std::string_view rest = text_.substr(position_);
  for (const std::string_view quote : {"\"\"\"", "'''", "@@@", "\"", "'", "@"}) {
    if (!rest.starts_with(quote)) continue;
    position_ += quote.size();
    return {UsdaToken::Kind::kQuoted, text_before(quote, quote.front() != '@')};
  }
  if (rest.front() == '<') {
    ++position_;
    return {UsdaToken::Kind::kQuoted, text_before(">", false)};
  }
  if (kSigns.find(rest.front()) != kSigns.npos) {
    ++position_;
    return {UsdaToken::Kind::kSign, rest.substr(0, 1)};
  }
  std::size_t length = 0;
  while (length < rest.size() && static_cast<unsigned char>(rest[length]) > ' ') {
    const bool is_array = rest.substr(length).starts_with("[]");
    if (!is_array && kEnds.find(rest[length]) != kEnds.npos) break;
    length += is_array ? 2 : 1;
  }
  length = std::max<std::size_t>(length, 1);
  position_ += length;
  return {UsdaToken::Kind::kWord, rest.substr(0, length)};
}

bool UsdaTokens::consume(char sign) {
  skip_blanks();
  if (position_ >= text_.size() || text_[position_] != sign) return false;
  ++position_;
  return true;
}

std::string UsdaTokens::consume_group(std::string_view key) {
  std::string value;
  bool is_next = false;
  for (int open = 1; open > 0;) {
    const UsdaToken token = next();
    if (token.kind == UsdaToken::Kind::kEnd) fail("it ends within brackets");
    if (token.is('(') || token.is('[') || token.is('{')) ++open;
    if (token.is(')') || token.is(']') || token.is('}')) --open;
    if (is_next && token.kind != UsdaToken::Kind::kSign) value = token.text;
    is_next = open == 1 && (token.is_word(key) || (is_next && token.is('=')));
  }
  return value;
}

std::vector<double> UsdaTokens::read_numbers(std::string_view list) {
  std::vector<double> numbers;
  int open = 0;
  do {
    skip_blanks();
    if (position_ >= text_.size()) fail("it ends within a list");
    const char c = text_[position_];
    if (c == '[' || c == '(' || c == ']' || c == ')' || c == ',') {
      open += c == '[' || c == '(' ? 1 : c == ',' ? 0 : -1;
      ++position_;
      continue;
    }
    if (text_.substr(position_).starts_with("None")) {
      position_ += 4;
      continue;
    }
    double number = 0;
    const auto [after, error] =
        std::from_chars(text_.data() + position_, text_.data() + text_.size(), number);
    if (error != std::errc() || !std::isfinite(number)) {
      const auto line = 1 + std::ranges::count(text_.substr(0, position_), '\n');
      throw InvalidInput(
          concat(name_, ':', line, ": expected numbers in ", list, ", found ", next().text));
    }
    position_ = static_cast<std::size_t>(after - text_.data());
    numbers.push_back(number);
    if (numbers.size() % 1024 == 0) throw_if_interrupted();
  } while (open > 0);
  return numbers;
}

}  // namespace crowdface
