// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/npy_array.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/little_endian.h"

namespace crowdface {
namespace {

constexpr std::string_view kNpyMagic = "\x93NUMPY";

double half(std::uint16_t bits) {
  const int exponent = bits >> 10U & 0x1fU;
  const double fraction = (bits & 0x3ffU) / 1024.0, sign = (bits & 0x8000U) != 0 ? -1 : 1;
  if (exponent == 0x1f) return fraction == 0 ? sign * INFINITY : NAN;
  return sign *
         (exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1 + fraction, exponent - 15));
}

template <class T>
double number_of(const char* at) {
  return static_cast<double>(number_at<T>(at));
}

using ReadNumber = double (*)(const char*);
/// Returns the function that reads a number of a type; null for an unknown type.
/// \param type  NumPy's name of the type, such as "f4"
ReadNumber reader_of(std::string_view type) {
  if (type == "f4") return number_of<float>;
  if (type == "f8") return number_of<double>;
  if (type == "f2") return [](const char* at) { return half(number_at<std::uint16_t>(at)); };
  if (type == "i1") return number_of<std::int8_t>;
  if (type == "i2") return number_of<std::int16_t>;
  if (type == "i4") return number_of<std::int32_t>;
  if (type == "i8") return number_of<std::int64_t>;
  if (type == "u1" || type == "b1") return number_of<std::uint8_t>;
  if (type == "u2") return number_of<std::uint16_t>;
  if (type == "u4") return number_of<std::uint32_t>;
  if (type == "u8") return number_of<std::uint64_t>;
  return nullptr;
}

/// The part of the header's dictionary that follows a key.
std::string_view value_of(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == header.npos) return {};
  const std::size_t colon = header.find(':', at);
  if (colon == header.npos) return {};
  header.remove_prefix(colon + 1);
  header.remove_prefix(std::min(header.find_first_not_of(' '), header.size()));
  return header;
}

std::optional<std::vector<std::size_t>> shape_of(std::string_view header) {
  std::string_view text = value_of(header, "'shape'");
  if (!text.starts_with('(') || text.find(')') == text.npos) return std::nullopt;
  text = text.substr(1, text.find(')') - 1);
  std::vector<std::size_t> shape;
  for (const std::string_view part : split(text, ',')) {
    const std::vector<std::string> words = words_of(part);
    if (words.empty()) continue;
    const auto size = parse_unsigned(words[0]);
    if (!size || words.size() > 1) return std::nullopt;
    shape.push_back(*size);
  }
  return shape;
}

/// Converts values from Fortran order (first index fastest) to C order (last index fastest).
std::vector<double> in_c_order(const std::vector<double>& values,
                               const std::vector<std::size_t>& shape) {
  std::vector<double> out(values.size());
  std::vector<std::size_t> index(shape.size(), 0);
  for (double& value : out) {
    std::size_t at = 0, step = 1;
    for (std::size_t d = 0; d < shape.size(); ++d) {
      at += index[d] * step;
      step *= shape[d];
    }
    value = values[at];
    for (std::size_t d = shape.size(); d-- > 0;) {
      if (++index[d] < shape[d]) break;
      index[d] = 0;
    }
  }
  return out;
}

}  // namespace

NpyArray parse_npy(std::string_view bytes, const std::string& name) {
  const auto fail = [&](std::string_view found) {
    throw InvalidInput(
        concat(name, ": expected an array of numbers that NumPy saved (.npy), found ", found));
  };
  constexpr std::size_t kShort = 10, kLong = 12;
  if (!bytes.starts_with(kNpyMagic) || bytes.size() < kLong) fail("another file");
  const bool is_short = bytes[6] == 1;
  const std::size_t begin = is_short ? kShort : kLong;
  const std::size_t length = is_short ? number_at<std::uint16_t>(bytes.data() + 8)
                                      : number_at<std::uint32_t>(bytes.data() + 8);
  if (length > bytes.size() - begin) fail("one that is cut off");
  const std::string_view header = bytes.substr(begin, length);
  std::string_view data = bytes.substr(begin + length);
  const std::string_view type = value_of(header, "'descr'");
  constexpr std::size_t kTypeText = 5;  // length of '<f4' with quotes
  const ReadNumber read = type.size() >= kTypeText && type[0] == '\'' && type[4] == '\''
                              ? reader_of(type.substr(2, 2))
                              : nullptr;
  if (read == nullptr) {
    fail(concat("elements of the type ", quoted(type.substr(0, type.find(", 'f"))),
                ": save numbers, without pickles"));
  }
  NpyArray array;
  const auto shape = shape_of(header);
  if (!shape) fail("no shape");
  array.shape = *shape;
  const auto size = static_cast<std::size_t>(type[3] - '0');
  std::size_t count = 1;
  for (const std::size_t extent : array.shape) {
    if (extent != 0 && count > data.size() / extent) fail("one that is cut off");
    count *= extent;
  }
  if (count > data.size() / size) fail("one that is cut off");
  array.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    char raw[8];
    std::copy_n(data.data() + i * size, size, raw);
    if (type[1] == '>') std::reverse(raw, raw + size);
    array.values.push_back(read(raw));
  }
  if (value_of(header, "'fortran_order'").starts_with("True")) {
    array.values = in_c_order(array.values, array.shape);
  }
  return array;
}

std::optional<std::vector<std::size_t>> npy_shape(const std::filesystem::path& path) {
  constexpr std::size_t kLongestHeader = 1000;
  try {
    const MappedFile file(path);
    const std::string_view header = file.bytes().substr(0, kLongestHeader);
    if (header.starts_with(kNpyMagic)) return shape_of(header);
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): whoever reads the file says why not
  }
  return std::nullopt;
}

NpyArray read_npy_array(const std::filesystem::path& path) {
  return parse_npy(MappedFile(path).bytes(), path.string());
}

}  // namespace crowdface
