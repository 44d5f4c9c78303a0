// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include <nlohmann/json.hpp>

namespace crowdface {

/// A binary answer with arrays of numbers. Layout: the length of a JSON text as uint32; the JSON
/// text, padded with blanks so that the arrays start at a multiple of four bytes; the arrays, in
/// the order in which the JSON key `arrays` describes them, each padded to a multiple of four
/// bytes. All numbers are little-endian.
class BinaryAnswer {
 public:
  /// The JSON object of the answer, without the key `arrays`, which bytes() adds.
  nlohmann::ordered_json json = nlohmann::ordered_json::object();

  /// Appends an array. \param name  name of the array; the JSON key `arrays` contains this name.
  template <class T>
  void add(std::string_view name, std::span<const T> values) {
    static_assert(std::endian::native == std::endian::little);
    add(name, element_type_name<T>(), values.size(),
        {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  }
  /// Returns the whole answer.
  std::string bytes() const;

 private:
  /// Returns the name of an element type, as the JSON key `arrays` contains it.
  template <class T>
  static constexpr std::string_view element_type_name() {
    if constexpr (std::is_same_v<T, float>) return "f32";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "u32";
    if constexpr (std::is_same_v<T, std::int16_t>) return "i16";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "u8";
  }
  /// \param type   element type, as element_type_name returns it.
  /// \param count  number of elements.
  void add(std::string_view name, std::string_view type, std::size_t count, std::string_view bytes);

  /// value of the JSON key `arrays`
  nlohmann::ordered_json arrays_ = nlohmann::ordered_json::array();
  std::string data_;  ///< bytes of all arrays, with padding
};

}  // namespace crowdface
