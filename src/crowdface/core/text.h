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

/// The whole of `text` as a finite decimal number, or nothing. Never depends on the locale; a
/// leading '+' is allowed, white space, hexadecimal, "nan" and "inf" are not.
std::optional<double> parse_double(std::string_view text);

/// The whole of `text` as an unsigned decimal integer, or nothing (sign, overflow, leftovers).
std::optional<std::uint64_t> parse_unsigned(std::string_view text);

/// Shortest decimal text that reads back as exactly this number.
std::string format_number(double value);
/// Fixed notation with this many decimals.
std::string format_fixed(double value, int decimals);

/// At least this many digits, zeros in front: "0007".
std::string zero_padded(std::uint64_t number, std::size_t digits);

/// The last of a number's hexadecimal digits, zeros in front: "00ff".
std::string hex(std::uint64_t number, std::size_t digits);

/// A to Z made small, everything else as it is.
std::string lower_case(std::string_view text);

/// `text` as a terminal may be given it: bytes of control characters but for the line's end, of marks
/// that turn the direction of writing, and of what is no UTF-8 become numbers in hexadecimal.
std::string printable(std::string_view text);

/// `text` between double quotes, printable, line ends and quotes escaped too; long text is shortened.
std::string quoted(std::string_view text);
/// The same; without it, std::quoted would be chosen for strings.
inline std::string quoted(const std::string& text) {
  return quoted(std::string_view(text));
}
inline std::string quoted(const char* text) {
  return quoted(std::string_view(text));
}

inline constexpr std::size_t kLongestName = 64;
inline constexpr std::size_t kLongestId = 2 * kLongestName + 22;  ///< CROWD_FAMILY_NUMBER
/// Whether it is a name that can be a file's on any system: at most `longest` letters (a–z), digits,
/// '_', '-' and '.', not starting with '.', and not empty; nor __proto__, by which a script's objects
/// keep what is none of theirs.
bool is_name(std::string_view text, std::size_t longest = kLongestName);

/// The candidate nearest to `word` by edit distance if it is near enough to be what was meant.
std::optional<std::string> nearest_word(std::string_view word,
                                        const std::vector<std::string>& candidates);

inline bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
/// Whether a byte is the second or a later one of a UTF-8 character.
inline bool is_utf8_continuation(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// Bytes of the UTF-8 character that `text`, not empty, starts with; 0 if it is none (RFC 3629: no
/// overlong forms, no surrogates, nothing above U+10FFFF).
std::size_t utf8_length(std::string_view text);

/// Whether all of `text` is UTF-8. (A file's name may hold any bytes.)
bool is_utf8(std::string_view text);

/// What stands between separators, be it nothing; of a text without one, all of it.
std::vector<std::string_view> split(std::string_view text, char separator);
/// The lines of a text without their ends.
std::vector<std::string_view> split_lines(std::string_view text);

/// What stands between blanks, tabs and returns.
std::vector<std::string> words_of(std::string_view text);

/// "a, b, c".
std::string join(const std::vector<std::string>& words, std::string_view separator = ", ");

namespace detail {
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

/// All parts one after the other; numbers in shortest, locale-free form.
template <class... Parts>
std::string concat(const Parts&... parts) {
  std::string out;
  (detail::append(out, parts), ...);
  return out;
}

}  // namespace crowdface
