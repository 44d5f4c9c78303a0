// SPDX-License-Identifier: Apache-2.0
#include "crowdface/core/text.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crowdface {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// The decimal exponent of the first nonzero digit: 2 for "123", -3 for "0.001", 998 for "0.1e999".
/// The function is needed because from_chars reports overflow and underflow with the same error.
long long decimal_exponent(std::string_view number) {
  if (number.starts_with('-')) number.remove_prefix(1);
  const std::size_t e = number.find_first_of("eE");
  const std::string_view digits = number.substr(0, e);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = std::min(digits.find_first_of("123456789"), digits.size());
  const auto distance = static_cast<long long>(point) - static_cast<long long>(first);
  const long long leading = first < point ? distance - 1 : distance;
  if (e == std::string_view::npos) return leading;
  std::string_view power = number.substr(e + 1);
  if (power.starts_with('+')) power.remove_prefix(1);
  long long exponent = 0;
  const auto error = std::from_chars(power.data(), power.data() + power.size(), exponent).ec;
  constexpr long long kHuge = 1'000'000'000'000;
  if (error != std::errc{}) return power.starts_with('-') ? -kHuge : kHuge;
  return leading + std::clamp(exponent, -kHuge, kHuge);
}

/// The UTF-8 character at `at`, or a single byte if the bytes at `at` are not valid UTF-8.
std::string_view character_at(std::string_view text, std::size_t at) {
  return text.substr(at, std::max<std::size_t>(utf8_length(text.substr(at)), 1));
}

/// Whether the character may make a terminal execute a command or reorder text. Such characters
/// are: control characters (C0, DEL, C1), line separators, marks of text direction, and bytes that
/// are not valid UTF-8.
bool is_unprintable(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  const auto within = [](unsigned value, unsigned low, unsigned high) {
    return value >= low && value <= high;
  };
  if (character.size() == 1) return byte(0) < 0x20 || byte(0) >= 0x7F;
  if (byte(0) == 0xC2) return byte(1) < 0xA0;    // U+0080 to U+009F
  if (byte(0) == 0xD8) return byte(1) == 0x9C;   // U+061C
  if (character == "\xEF\xBB\xBF") return true;  // U+FEFF
  if (character.size() != 3 || byte(0) != 0xE2) return false;
  return (byte(1) == 0x80 && (within(byte(2), 0x8E, 0x8F) || within(byte(2), 0xA8, 0xAE))) ||
         (byte(1) == 0x81 && within(byte(2), 0xA6, 0xA9));  // U+200E, U+2028…, U+2066…
}

/// Appends a character, or its bytes as hexadecimal escapes if it is unprintable.
void append_printable(std::string_view character, std::string& out) {
  if (!is_unprintable(character)) {
    out += character;
    return;
  }
  for (const char c : character) out += "\\x" + hex(static_cast<unsigned char>(c), 2);
}

}  // namespace

std::optional<double> parse_double(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  if (text.empty()) return std::nullopt;
  // Rejects "nan" and "inf", which from_chars accepts: a number starts with a digit, point or
  // minus.
  const char first = text.front() == '-' && text.size() > 1 ? text[1] : text.front();
  if (!(first >= '0' && first <= '9') && first != '.') return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Underflow gives 0; overflow is an error.
    return decimal_exponent(text) < 0 ? std::optional<double>(0.0) : std::nullopt;
  }
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> parse_unsigned(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string format_number(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string format_fixed(double value, int decimals) {
  char buffer[400];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals).ptr;
  return {buffer, end};
}

std::string zero_padded(std::uint64_t number, std::size_t digits) {
  std::string text = concat(number);
  if (text.size() < digits) text.insert(0, digits - text.size(), '0');
  return text;
}

std::string hex(std::uint64_t number, std::size_t digits) {
  std::string out(digits, '0');
  for (; digits > 0; number >>= 4U) out[--digits] = "0123456789abcdef"[number & 15U];
  return out;
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view character = character_at(text, at);
    if (character == "\n") {
      out += character;
    } else {
      append_printable(character, out);
    }
    at += character.size();
  }
  return out;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  std::string out = "\"";
  std::size_t at = 0;
  while (at < text.size()) {
    const std::string_view character = character_at(text, at);
    if (at + character.size() > kLongest) break;
    if (character == "\"" || character == "\\") out += '\\';
    append_printable(character, out);
    at += character.size();
  }
  if (at < text.size()) out += "…";
  return out + '"';
}

bool is_valid_name(std::string_view text, std::size_t max_length) {
  return !text.empty() && text.size() <= max_length && text.front() != '.' && text != "__proto__" &&
         text.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") == text.npos;
}

std::optional<std::string> nearest_word(std::string_view word,
                                        const std::vector<std::string>& candidates) {
  std::optional<std::string> best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance && distance < candidate.size()) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_utf8_continuation(text[i])) return 0;
  }
  const auto second = static_cast<unsigned char>(text[1]);
  const bool refused = (lead == 0xe0 && second < 0xa0) || (lead == 0xed && second > 0x9f) ||
                       (lead == 0xf0 && second < 0x90) || (lead == 0xf4 && second > 0x8f);
  return refused ? 0 : length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (std::size_t at = 0; at != text.npos;) {
    at = text.find(separator);
    pieces.push_back(text.substr(0, at));
    if (at != text.npos) text.remove_prefix(at + 1);
  }
  return pieces;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines = split(text, '\n');
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

std::vector<std::string> words_of(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(kBlanks, at)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

std::string join(const std::vector<std::string>& words, std::string_view separator) {
  std::string out;
  for (const std::string& word : words) {
    if (&word != &words.front()) out += separator;
    out += word;
  }
  return out;
}

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    const std::string_view digits = text.substr(i + 1, 2);
    unsigned value = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    if (digits.size() != 2 || read.ptr != digits.data() + 2) return std::nullopt;
    decoded += static_cast<char>(value);
    i += 2;
  }
  return decoded;
}

}  // namespace crowdface
