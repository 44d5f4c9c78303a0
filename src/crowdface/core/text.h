// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crowdface {

/// Parses the whole of `text` as a finite decimal number; nothing if that fails. Independent of the
/// locale. A leading '+' is allowed; white space, hexadecimal, "nan" and "inf" are not.
std::optional<double> parse_double(std::string_view text);

/// Parses the whole of `text` as an unsigned decimal integer; nothing if the text has a sign or
/// trailing characters, or if the number overflows.
std::optional<std::uint64_t> parse_unsigned(std::string_view text);

/// Formats a number as the shortest decimal text that reads back as exactly `value`.
std::string format_number(double value);
/// Formats a number in fixed-point notation with `decimals` digits after the point.
std::string format_fixed(double value, int decimals);

/// Pads with zeros to at least `digits` digits: "0007".
std::string zero_padded(std::uint64_t number, std::size_t digits);

/// The lowest `digits` hexadecimal digits of a number, padded with zeros, such as "00ff".
std::string hex(std::uint64_t number, std::size_t digits);

/// Converts A–Z to lower case; other characters stay.
std::string lower_case(std::string_view text);

/// Makes `text` safe for a terminal. Line separators, marks of text direction, invalid UTF-8 and
/// control characters (except line ends) become hexadecimal escapes.
std::string printable(std::string_view text);

/// `text` in double quotes, made safe as by `printable`. Also escapes line ends, quotes and
/// backslashes. Keeps only the first 80 bytes of the text.
std::string quoted(std::string_view text);
/// These overloads exist because overload resolution would otherwise choose std::quoted for their
/// argument types.
inline std::string quoted(const std::string& text) {
  return quoted(std::string_view(text));
}
inline std::string quoted(const char* text) {
  return quoted(std::string_view(text));
}

inline constexpr std::size_t kMaxNameLength = 64;  ///< longest name in a config, in bytes
/// Longest id of a face, in bytes. An id is at most CROWD_FAMILY_NUMBER: two names and a number.
inline constexpr std::size_t kMaxIdLength = 2 * kMaxNameLength + 22;
/// Whether `text` can be a file name on any system. The text must have 1 to `max_length`
/// characters, each a letter (A–Z, a–z), digit, '_', '-' or '.', and must not start with '.'.
/// "__proto__" is refused because in JavaScript it would set an object's prototype.
bool is_valid_name(std::string_view text, std::size_t max_length = kMaxNameLength);

/// The candidate with the least edit distance to `word`; nothing if `word` is too different from
/// all candidates to be a misspelling.
std::optional<std::string> nearest_word(std::string_view word,
                                        const std::vector<std::string>& candidates);

/// Whether a character is a space or a tab.
inline bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
/// Whether a byte is a continuation byte of UTF-8.
inline bool is_utf8_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// Number of bytes of the UTF-8 character at the start of `text`; 0 if the bytes are invalid (RFC
/// 3629: no overlong forms, no surrogates, nothing above U+10FFFF). \param text  not empty.
std::size_t utf8_length(std::string_view text);

/// Whether all of `text` is valid UTF-8. (File names may hold any bytes.)
bool is_utf8(std::string_view text);

/// The parts between separators, including empty parts. A text without a separator is one part.
std::vector<std::string_view> split(std::string_view text, char separator);
/// The lines of a text, without '\n'.
std::vector<std::string_view> split_lines(std::string_view text);

/// The words of a text, separated by blanks, tabs and carriage returns.
std::vector<std::string> words_of(std::string_view text);

/// Concatenates words with the separator between them: "a, b, c".
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

namespace detail {
/// The overloads of `append` append one argument of `concat` to `out`.
inline void append(std::string& out, std::string_view text) {
  out += text;
}
inline void append(std::string& out, char c) {
  out += c;
}
inline void append(std::string& out, double value) {
  out += format_number(value);
}
template <std::integral T>
void append(std::string& out, T value) {
  char buffer[24];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  out.append(buffer, end);
}
}  // namespace detail

/// Concatenates strings, characters and numbers. Numbers take the shortest form, independent of the
/// locale.
template <class... Parts>
std::string concat(const Parts&... parts) {
  std::string out;
  (detail::append(out, parts), ...);
  return out;
}

/// Decodes percent escapes such as "%20" (RFC 3986). Returns nothing if an escape is incomplete.
std::optional<std::string> percent_decoded(std::string_view text);

}  // namespace crowdface
