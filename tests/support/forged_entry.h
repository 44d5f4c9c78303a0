// SPDX-License-Identifier: Apache-2.0
// Entries of the cache that hold other numbers under a right checksum; bytes as heads/cache_entry.cpp writes them.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "crowdface/core/hash.h"

namespace crowdface::testing {

/// The bytes with another number at this place, and the checksum that goes with them.
template <class T>
std::string forged_at(std::string bytes, std::size_t place, T number) {
  std::memcpy(bytes.data() + place, &number, sizeof number);
  const std::size_t content = bytes.size() - sizeof(Digest);
  const Digest sum = hash_bytes(std::string_view(bytes).substr(0, content));
  std::memcpy(bytes.data() + content, &sum, sizeof sum);
  return bytes;
}

/// Where the entry describes an array: at 28 its columns, at 32 its rows, at 40 its place.
inline std::size_t row_of_array(const std::string& bytes, std::string_view name) {
  std::uint32_t arrays = 0;
  std::memcpy(&arrays, bytes.data() + 12, sizeof arrays);
  for (std::size_t row = 32; row < 32 + 48 * std::size_t{arrays}; row += 48) {
    if (name == bytes.data() + row) return row;
  }
  ADD_FAILURE() << "no array " << name;
  return 32;
}

/// The place of an array's numbers.
inline std::size_t place_of_array(const std::string& bytes, std::string_view name) {
  std::uint64_t place = 0;
  std::memcpy(&place, bytes.data() + row_of_array(bytes, name) + 40, sizeof place);
  return place;
}

/// \param at  bytes from the beginning of the array
template <class T>
std::string forged_array(const std::string& bytes, std::string_view name, std::size_t at,
                         T number) {
  return forged_at(bytes, place_of_array(bytes, name) + at, number);
}

}  // namespace crowdface::testing
