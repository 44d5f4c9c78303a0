// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_colours.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "crowdface/core/text.h"
#include "crowdface/io/obj_statements.h"

namespace crowdface {
namespace {

constexpr std::string_view kPolypaint = "#MRGB";
constexpr double kMaxColourByte = 255;
constexpr std::uint8_t kWhite = 255;

bool is_vertex(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t");
  return at != line.npos && line[at] == 'v' && at + 1 < line.size() && is_blank(line[at + 1]);
}

/// A part of a model from ZBrush, with the `#MRGB` colours of its vertices.
struct Subtool {
  std::size_t vertex_count = 0;
  std::vector<std::uint8_t> colours;  ///< three bytes per vertex; empty: the part has no colours
};

/// Appends the colours of an `#MRGB` line. Returns false if the line is wrong.
/// \param line  the line without `#MRGB`
bool add_polypaint(std::string_view line, std::vector<std::uint8_t>& colours) {
  constexpr std::size_t kDigitsEach = 8;  // MMRRGGBB: a mask, then the colour
  for (const std::string& word : words_of(line)) {
    for (std::size_t at = 0; at + kDigitsEach <= word.size(); at += kDigitsEach) {
      std::uint32_t number = 0;
      const char* const begin = word.data() + at;
      const auto [end, error] = std::from_chars(begin, begin + kDigitsEach, number, 16);
      if (error != std::errc() || end != begin + kDigitsEach) return false;
      for (const int shift : {16, 8, 0})
        colours.push_back(static_cast<std::uint8_t>(number >> shift));
    }
  }
  return true;
}

}  // namespace

ColourRows byte_colours(const ColourValues& fractions) {
  return (kMaxColourByte * fractions.array()).round().matrix().cast<std::uint8_t>();
}

ColourValues colour_fractions(const ColourRows& colours) {
  return colours.cast<double>() / kMaxColourByte;
}

ColourRows obj_colours(std::string_view text, Eigen::Index vertices) {
  constexpr std::size_t kFirst = 4, kMinWords = 7;  // "v", x y z, r g b
  constexpr std::ptrdiff_t kMinBlanks = 6;
  constexpr double kNone = std::numeric_limits<double>::lowest();
  const auto count = static_cast<std::size_t>(vertices);
  std::vector<std::array<double, 3>> found;  // #vertices; empty before the first colour
  std::size_t vertex = 0, coloured = 0;
  double most = 1;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view line = next_obj_line(text, at);
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
  const double scale = most > kLargestFraction ? 1 : kMaxColourByte;
  for (Eigen::Index v = 0; v < vertices; ++v) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      const double number = found[static_cast<std::size_t>(v)][static_cast<std::size_t>(c)];
      const double value = number == kNone ? kMaxColourByte : scale * number;
      colours(v, c) =
          static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, kMaxColourByte)));
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
      out += concat(' ', format_fixed(colours(vertex, c) / kMaxColourByte, kDigits));
    }
    out += '\n';
    ++vertex;
  }
  return out;
}

std::optional<std::string> move_polypaint_to_vertices(std::string_view text) {
  if (text.find(kPolypaint) == text.npos) return std::nullopt;
  // The lines of a subtool are together in the file: first its vertices, then its colours, then its
  // polygons.
  std::vector<Subtool> subtools(1);
  bool are_vertices_complete = false;
  for (const std::string_view line : split_lines(text)) {
    if (is_vertex(line)) {
      if (std::exchange(are_vertices_complete, false)) subtools.emplace_back();
      ++subtools.back().vertex_count;
    } else if (line.starts_with("f ")) {
      are_vertices_complete = true;
    } else if (line.starts_with(kPolypaint) &&
               !add_polypaint(line.substr(kPolypaint.size()), subtools.back().colours)) {
      return std::nullopt;
    }
  }
  std::size_t vertices = 0, coloured = 0;
  std::vector<std::uint8_t> in_order, of_subtools;
  for (const Subtool& subtool : subtools) {
    const std::vector<std::uint8_t>& colours = subtool.colours;
    vertices += subtool.vertex_count;
    coloured += colours.size() / 3;
    in_order.insert(in_order.end(), colours.begin(), colours.end());
    if (colours.size() == 3 * subtool.vertex_count) {
      of_subtools.insert(of_subtools.end(), colours.begin(), colours.end());
    } else if (colours.empty()) {
      of_subtools.insert(of_subtools.end(), 3 * subtool.vertex_count, kWhite);
    }
  }
  if (vertices == 0 || 2 * coloured < vertices) return std::nullopt;
  const auto& bytes = in_order.size() == 3 * vertices ? in_order : of_subtools;
  if (bytes.size() != 3 * vertices) return std::nullopt;
  return with_colours(
      text, Eigen::Map<const ColourRows>(bytes.data(), static_cast<Eigen::Index>(vertices), 3));
}

}  // namespace crowdface
