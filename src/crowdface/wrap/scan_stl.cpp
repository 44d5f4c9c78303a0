// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/wrap/scan_file.h"

namespace crowdface {
namespace {

constexpr std::size_t kHeader = 84, kRecord = 50, kNormal = 12;

[[noreturn]] void fail(const std::string& name, const std::string& found) {
  throw InvalidInput(concat(name, ": expected an STL file, found that ", found));
}

Scan soup(const std::vector<double>& numbers) {
  Scan scan;
  scan.positions.resize(static_cast<Index>(numbers.size() / 3), 3);
  std::copy(numbers.begin(), numbers.end(), scan.positions.data());
  for (std::uint32_t v = 0; v + 2 < numbers.size() / 3; v += 3) {
    scan.triangles.push_back({v, v + 1, v + 2});
  }
  return scan;
}

Scan parse_text(std::string_view text, const std::string& name) {
  std::vector<double> numbers;
  constexpr std::string_view kVertex = "vertex";
  for (std::size_t at = text.find(kVertex); at != std::string_view::npos;
       at = text.find(kVertex, at)) {
    at += kVertex.size();
    for (int c = 0; c < 3; ++c) {
      const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n", at), text.size());
      at = std::min(text.find_first_of(" \t\r\n", begin), text.size());
      const auto number = parse_double(text.substr(begin, at - begin));
      if (!number) fail(name, concat("a number reads ", quoted(text.substr(begin, at - begin))));
      numbers.push_back(*number);
    }
  }
  if (numbers.size() % 9 != 0) fail(name, "a facet has no three vertices");
  return soup(numbers);
}

}  // namespace

Scan parse_stl(std::string_view bytes, const std::string& name) {
  // Binary files may begin with "solid" too: their length tells.
  std::uint32_t count = 0;
  if (bytes.size() >= kHeader) std::memcpy(&count, bytes.data() + kHeader - 4, 4);
  if (bytes.size() < kHeader || bytes.size() != kHeader + kRecord * std::size_t{count}) {
    if (bytes.starts_with("solid")) return parse_text(bytes, name);
    fail(name, concat("it has ", bytes.size(), " bytes and claims ", count, " triangles"));
  }
  std::vector<double> numbers;
  numbers.reserve(9 * std::size_t{count});
  for (std::size_t t = 0; t < count; ++t) {
    for (std::size_t i = 0; i < 9; ++i) {
      float value = 0;
      std::memcpy(&value, bytes.data() + kHeader + kRecord * t + kNormal + 4 * i, 4);
      numbers.push_back(value);
    }
  }
  return soup(numbers);
}

}  // namespace crowdface
