// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

namespace crowdface {

// The binary mesh formats are little endian. The code below copies numbers without conversion, so
// the processor must be little endian too.
static_assert(std::endian::native == std::endian::little);

/// Writes the number's bytes to `out`.
/// \return the end of the output.
template <class Number>
char* put_number(char* out, Number number) {
  std::memcpy(out, &number, sizeof number);
  return out + sizeof number;
}

/// Reads a number in little-endian order.
template <class Number>
Number number_at(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// Reads a number in big-endian order.
inline std::uint32_t big_endian_at(const char* bytes) {
  return __builtin_bswap32(number_at<std::uint32_t>(bytes));
}

/// Appends the number's bytes to a text.
template <class Number>
void append_number(std::string& out, Number number) {
  char bytes[sizeof number];
  out.append(bytes, put_number(bytes, number));
}

/// Appends the bytes of an array's elements to a text.
template <class Array>
void append_array(std::string& out, const Array& array) {
  out.append(reinterpret_cast<const char*>(array.data()), array.size() * sizeof(array[0]));
}

}  // namespace crowdface
