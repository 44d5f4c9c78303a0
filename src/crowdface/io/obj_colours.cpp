// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_colours.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

constexpr std::string_view kPolypaint = "#MRGB";
constexpr double kMaxByte = 255;

bool is_vertex(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t");
  return at != line.npos && line[at] == 'v' && at + 1 < line.size() && is_blank(line[at + 1]);
}

}  // namespace

ColourRows byte_colours(const Positions& fractions) {
  return (kMaxByte * fractions.array()).round().matrix().cast<std::uint8_t>();
}

Positions colour_fractions(const ColourRows& colours) {
  return colours.cast<double>() / kMaxByte;
}

ColourRows obj_colours(std::string_view text, Eigen::Index vertices) {
  constexpr std::size_t kFirst = 4, kMinWords = 7;  // "v", x y z, r g b
  constexpr std::ptrdiff_t kMinBlanks = 6;
  constexpr double kNone = std::numeric_limits<double>::lowest();
  const auto count = static_cast<std::size_t>(vertices);
  std::vector<std::array<double, 3>> found;  // #vertices; empty before the first colour
  std::size_t vertex = 0, coloured = 0;
  double most = 1;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    if (!is_vertex(line)) continue;
    if (vertex == count) return ColourRows(0, 3);
    const std::size_t v = vertex++;
    if (std::ranges::count_if(line, is_blank) < kMinBlanks) continue;
    const std::vector<std::string> words = words_of(line);
    if (words.size() < kMinWords) continue;
    if (found.empty()) found.assign(count, {kNone, kNone, kNone});
    for (std::size_t c = 0; c < 3; ++c) {
      const auto number = parse_double(words[kFirst + c]);
      if (!number || !std::isfinite(*number)) return ColourRows(0, 3);
      found[v][c] = *number;
      most = std::max(most, *number);
    }
    ++coloured;
  }
  if (found.empty() || vertex != count || 2 * coloured < count) return ColourRows(0, 3);
  ColourRows colours(vertices, 3);
  const double scale = most > kLargestFraction ? 1 : kMaxByte;
  for (Eigen::Index v = 0; v < vertices; ++v) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      const double number = found[static_cast<std::size_t>(v)][static_cast<std::size_t>(c)];
      const double value = number == kNone ? kMaxByte : scale * number;
      colours(v, c) = static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, kMaxByte)));
    }
  }
  return colours;
}

std::string with_colours(std::string_view text, const ColourRows& colours) {
  constexpr std::size_t kPlaces = 4;
  constexpr int kDigits = 4;
  std::string out;
  out.reserve(text.size() + 24 * static_cast<std::size_t>(colours.rows()));
  Eigen::Index vertex = 0;
  for (const std::string_view line : split_lines(text)) {
    if (line.starts_with(kPolypaint)) continue;
    if (!is_vertex(line) || vertex >= colours.rows()) {
      out += concat(line, '\n');
      continue;
    }
    const std::vector<std::string> words = words_of(line);
    for (std::size_t w = 0; w < std::min(kPlaces, words.size()); ++w) {
      out += concat(w == 0 ? "" : " ", words[w]);
    }
    for (Eigen::Index c = 0; c < 3; ++c) {
      out += concat(' ', format_fixed(colours(vertex, c) / kMaxByte, kDigits));
    }
    out += '\n';
    ++vertex;
  }
  return out;
}

std::optional<std::string> move_polypaint_to_vertices(std::string_view text) {
  constexpr std::size_t kDigitsEach = 8;  // MMRRGGBB: a mask, then the colour
  if (text.find(kPolypaint) == text.npos) return std::nullopt;
  std::vector<std::uint8_t> bytes;
  std::size_t vertices = 0;
  for (const std::string_view line : split_lines(text)) {
    vertices += is_vertex(line) ? 1U : 0U;
    if (!line.starts_with(kPolypaint)) continue;
    const std::vector<std::string> words = words_of(line.substr(kPolypaint.size()));
    for (const std::string& word : words) {
      for (std::size_t at = 0; at + kDigitsEach <= word.size(); at += kDigitsEach) {
        std::uint32_t number = 0;
        const char* const begin = word.data() + at;
        const auto [end, error] = std::from_chars(begin, begin + kDigitsEach, number, 16);
        if (error != std::errc() || end != begin + kDigitsEach) return std::nullopt;
        for (const int shift : {16, 8, 0})
          bytes.push_back(static_cast<std::uint8_t>(number >> shift));
      }
    }
  }
  if (vertices == 0 || bytes.size() != 3 * vertices) return std::nullopt;
  return with_colours(
      text, Eigen::Map<const ColourRows>(bytes.data(), static_cast<Eigen::Index>(vertices), 3));
}

}  // namespace crowdface
