// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_template.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_statements.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

constexpr std::size_t kRangesPerBlock = 8192;

char* copy(std::string_view text, char* out) {
  std::memcpy(out, text.data(), text.size());
  return out + text.size();
}

/// Writes the coordinates of vertex i, then its red, green and blue.
char* write_coloured(char* out, const Positions& rows, const ColourRows& colours, Index i) {
  constexpr double kMaxByte = 255, kSteps = 1e4;
  for (Index c = 0; c < 3; ++c) {
    if (c > 0) *out++ = ' ';
    out = write_single(out, rows(i, c));
  }
  for (Index c = 0; c < 3; ++c) {
    *out++ = ' ';
    out = write_single(out, std::round(kSteps * colours(i, c) / kMaxByte) / kSteps);
  }
  return out;
}

/// The part of a `v` or `vn` line that holds the numbers x y z.
struct Coordinates {
  std::string_view text;  ///< the three numbers; empty if the line is neither `v` nor `vn`
  bool is_normal = false;
};

/// Finds the three numbers in a `v` or `vn` line.
/// \param whole  whether the result includes the rest of a `v` line (`w` and colours)
Coordinates coordinates_of(std::string_view line, bool whole) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (whole) {
    while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  }
  std::size_t at = 0;
  const auto skip = [&](bool blanks) {
    while (at < line.size() && is_blank(line[at]) == blanks) ++at;
  };
  skip(true);
  if (at == line.size() || line[at] != 'v') return {};
  const bool is_normal = line.substr(++at).starts_with('n');
  if (is_normal) ++at;
  if (at == line.size() || !is_blank(line[at])) return {};
  skip(true);
  const std::size_t begin = at;
  skip(false);
  for (int more = 0; more < 2; ++more) {
    skip(true);
    skip(false);
  }
  if (whole && !is_normal) at = line.size();
  return {line.substr(begin, at - begin), is_normal};
}

/// Checks that the text still has the number of vertices that it had when the target was read, and
/// that it has every normal that a corner uses.
void check_row_counts(const ObjFile& target, std::uint32_t vertices, Index expected,
                      std::uint32_t normals) {
  bool fits = static_cast<Index>(vertices) == expected;
  for (const std::uint32_t row : target.corner_normals) {
    fits = fits && (row == kNoIndex || row < normals);
  }
  if (fits) return;
  throw InvalidInput(concat(target.path.string(), ": expected ", expected,
                            " vertices, and normals for all corners, found ", vertices, " and ",
                            normals));
}

/// Writes the three numbers of a row in place of three old numbers, and keeps the blanks between
/// the old numbers.
char* write_like(std::string_view old, char* out, const Positions& rows, Index i) {
  std::size_t at = 0;
  for (Index c = 0; c < 3; ++c) {
    out = write_single(out, rows(i, c));
    while (at < old.size() && !is_blank(old[at])) ++at;
    while (at < old.size() && is_blank(old[at])) *out++ = old[at++];
  }
  return out;
}

bool is_zero(const Positions& rows, Index i) {
  return rows(i, 0) == 0 && rows(i, 1) == 0 && rows(i, 2) == 0;
}

}  // namespace

ObjTemplate::ObjTemplate(const ObjFile& target, const Topology& topology, bool colours,
                         const GivenNormals& fixed)
    : text_(target.file.bytes()),
      topology_(topology),
      vertex_count_(topology.vertex_count),
      has_colours_(colours) {
  // If no polygon uses normals, `vn` lines are copied unchanged.
  const bool has_normals = !target.corner_normals.empty();
  std::uint32_t vertices = 0, normals = 0;
  std::vector<NumberRange> ranges;  // vertices and normals may be interleaved
  for (std::size_t at = 0; at < text_.size();) {
    const auto [numbers, is_normal] = coordinates_of(next_obj_line(text_, at), colours);
    if (numbers.empty() || (is_normal && !has_normals)) continue;
    const bool ends_run = !ranges.empty() && ranges.back().is_normal != is_normal &&
                          ranges.size() > kRangesPerBlock / 2;
    if (ranges.size() == kRangesPerBlock || ends_run) {
      add_block(ranges);
      ranges.clear();
    }
    ranges.push_back({static_cast<std::uint64_t>(numbers.data() - text_.data()),
                      static_cast<std::uint32_t>(numbers.size()),
                      (is_normal ? normals++ : vertices++) & 0x7fffffffU, is_normal});
  }
  if (!ranges.empty()) add_block(ranges);
  check_row_counts(target, vertices, vertex_count_, normals);
  if (!has_normals) return;
  fans_.emplace(topology, target.corner_normals, normals);
  set_given_normals(target.corner_normals, fixed);
}

void ObjTemplate::set_given_normals(const std::vector<std::uint32_t>& corner_rows,
                                    const GivenNormals& given) {
  if (given.vertices.empty()) return;
  // For each normal, the vertex whose corners use it; kNoIndex if corners of several vertices use
  // the normal.
  std::vector<std::uint32_t> vertices(static_cast<std::size_t>(fans_->rows()), kNoIndex);
  std::vector<bool> is_used(vertices.size(), false);
  for (std::size_t c = 0; c < corner_rows.size(); ++c) {
    const std::uint32_t row = corner_rows[c], vertex = topology_.corner_vertices[c];
    if (row == kNoIndex) continue;
    if (!is_used[row]) vertices[row] = vertex;
    if (vertices[row] != vertex) vertices[row] = kNoIndex;
    is_used[row] = true;
  }
  std::map<std::uint32_t, Index> numbers;
  for (const std::uint32_t vertex : given.vertices) {
    numbers.emplace(vertex, static_cast<Index>(numbers.size()));
  }
  for (std::uint32_t row = 0; row < vertices.size(); ++row) {
    const auto found = numbers.find(vertices[row]);
    if (found != numbers.end()) given_normals_.emplace_back(row, given.normals.row(found->second));
  }
}

void ObjTemplate::add_block(const std::vector<NumberRange>& ranges) {
  Block block;
  block.begin = blocks_.empty() ? 0 : blocks_.back().end;
  block.end = ranges.back().begin + ranges.back().length;
  block.output_offset = buffer_size_;
  // Upper bound of the output's length: the new numbers at maximum length, plus the old text
  // without the digits of positions. The digits of normals stay in the sum, because a normal that
  // no polygon uses keeps its text.
  std::size_t old_text = block.end - block.begin;
  for (const NumberRange& range : ranges) {
    if (range.is_normal) continue;
    old_text -= static_cast<std::size_t>(std::ranges::count_if(
        text_.substr(range.begin, range.length), [](char c) { return !is_blank(c); }));
  }
  const std::size_t colours = has_colours_ ? (3 * kMaxFloatTextLength + 5) * ranges.size() : 0;
  buffer_size_ +=
      3 * kMaxFloatTextLength * ranges.size() + colours + old_text + kMaxFloatTextLength;
  block.ranges = ranges;
  blocks_.push_back(std::move(block));
}

std::size_t ObjTemplate::memory_bytes() const {
  std::size_t bytes = blocks_.size() * sizeof(Block) + (fans_ ? fans_->memory_bytes() : 0);
  for (const Block& block : blocks_) bytes += block.ranges.size() * sizeof(NumberRange);
  return bytes;
}

std::size_t ObjTemplate::encoding_memory_bytes() const {
  const auto rows = static_cast<std::size_t>(fans_ ? fans_->rows() + topology_.face_count() : 0);
  return buffer_size_ + rows * 3 * sizeof(double);
}

EncodedFile ObjTemplate::encode(const Positions& positions, const std::string& what,
                                const ColourRows& colours) const {
  require_finite(positions, vertex_count_, what);
  require(!has_colours_ || colours.rows() == vertex_count_, "ObjTemplate: a colour of each vertex");
  Positions normals;
  if (fans_) normals = fans_->normals(topology_, positions, {0, 0, 0});
  for (const auto& [row, normal] : given_normals_) normals.row(row) = normal;
  const NewValues rows{positions, normals, colours};
  EncodedFile file;
  char* buffer = file.reserve(buffer_size_);
  std::vector<std::string_view> pieces(blocks_.size());
  parallel_for_each(blocks_.size(), [&](std::size_t b) {
    char* begin = buffer + blocks_[b].output_offset;
    const char* end = encode_block(blocks_[b], rows, begin);
    pieces[b] = {begin, static_cast<std::size_t>(end - begin)};
  });
  for (const std::string_view piece : pieces) file.add_without_copy(piece);
  file.add_without_copy(text_.substr(blocks_.empty() ? 0 : blocks_.back().end));
  return file;
}

char* ObjTemplate::encode_block(const Block& block, const NewValues& rows, char* out) const {
  std::uint64_t at = block.begin;
  for (const NumberRange& range : block.ranges) {
    out = copy(text_.substr(at, range.begin - at), out);
    out = encode_range(range, rows, out);
    at = range.begin + range.length;
  }
  return out;
}

char* ObjTemplate::encode_range(const NumberRange& range, const NewValues& rows, char* out) const {
  const std::string_view old = text_.substr(range.begin, range.length);
  if (!range.is_normal && has_colours_) {
    return write_coloured(out, rows.positions, rows.colours, range.row);
  }
  if (!range.is_normal) return write_like(old, out, rows.positions, range.row);
  if (is_zero(rows.normals, range.row)) return copy(old, out);
  return write_like(old, out, rows.normals, range.row);
}

}  // namespace crowdface
