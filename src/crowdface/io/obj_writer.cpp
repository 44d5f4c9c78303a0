// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_writer.h"

#include <cmath>
#include <functional>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/mesh/normals.h"

namespace crowdface {
namespace {

constexpr Index kLinesPerBlock = 8192;

void append_single(std::string& out, double value) {
  char buffer[32];
  float single = static_cast<float>(value);
  if (single == 0) single = 0;  // no negative zero
  out.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, single).ptr);
}

void append_row(std::string& out, const Positions& rows, Index i) {
  for (Index c = 0; c < 3; ++c) {
    if (c > 0) out += ' ';
    append_single(out, rows(i, c));
  }
}

/// The three numbers of a row in the place of three others, with the old blanks between them.
void append_like(std::string& out, std::string_view old, const Positions& rows, Index i) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  std::size_t at = 0;
  for (Index c = 0; c < 3; ++c) {
    append_single(out, rows(i, c));
    while (at < old.size() && !blank(old[at])) ++at;
    while (at < old.size() && blank(old[at])) out += old[at++];
  }
}

/// Formats `count` lines in parallel blocks.
std::vector<std::string> format_blocks(Index count,
                                       const std::function<void(std::string&, Index)>& append) {
  std::vector<std::string> blocks(
      static_cast<std::size_t>((count + kLinesPerBlock - 1) / kLinesPerBlock));
  parallel_blocks(count, kLinesPerBlock, [&](Index begin, Index end) {
    std::string& block = blocks[static_cast<std::size_t>(begin / kLinesPerBlock)];
    for (Index i = begin; i < end; ++i) append(block, i);
  });
  return blocks;
}

/// A place in the target's text, and the row that comes there.
struct Replacement {
  TextSpan span;
  const Positions* rows;
  Index row;
};

/// All places in the order of the file; vertices and normals may be interleaved.
std::vector<Replacement> replacements(const ObjFile& target, const Positions& positions,
                                      const Positions& normals) {
  std::vector<Replacement> all;
  all.reserve(target.vertex_spans.size() + target.normal_spans.size());
  std::size_t v = 0, n = 0;
  while (v < target.vertex_spans.size() || n < target.normal_spans.size()) {
    const bool vertex_next = n == target.normal_spans.size() ||
                             (v < target.vertex_spans.size() &&
                              target.vertex_spans[v].begin < target.normal_spans[n].begin);
    if (vertex_next) {
      all.push_back({target.vertex_spans[v], &positions, static_cast<Index>(v)});
      ++v;
    } else {
      all.push_back({target.normal_spans[n], &normals, static_cast<Index>(n)});
      ++n;
    }
  }
  return all;
}

/// #N by 3: each `vn` from the faces whose corners use it; zero where none does.
Positions normals_by_index(const ObjFile& target, const Topology& topology,
                           const Positions& positions) {
  Positions normals = Positions::Zero(static_cast<Index>(target.normal_spans.size()), 3);
  if (target.corner_normals.empty()) return normals;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Eigen::RowVector3d area = face_area_vector(topology, f, positions);
    for (auto c = topology.face_offsets[static_cast<std::size_t>(f)];
         c < topology.face_offsets[static_cast<std::size_t>(f) + 1]; ++c) {
      const std::uint32_t normal = target.corner_normals[c];
      if (normal != kNoIndex) normals.row(normal) += area;
    }
  }
  for (Index i = 0; i < normals.rows(); ++i) {
    const double length = std::sqrt(normals(i, 0) * normals(i, 0) + normals(i, 1) * normals(i, 1) +
                                    normals(i, 2) * normals(i, 2));
    if (length > 0) normals.row(i) /= length;
  }
  return normals;
}

void require_finite(const Positions& positions, Index vertices, const std::filesystem::path& path) {
  if (positions.rows() != vertices) {
    throw InvalidInput(
        concat(path.string(), ": expected ", vertices, " positions, got ", positions.rows()));
  }
  if (!positions.allFinite()) {
    throw InvalidInput(concat(path.string(), ": a position is not finite; nothing was written"));
  }
}

Digest write_blocks(const std::filesystem::path& path,
                    const std::vector<std::vector<std::string>>& groups, std::string_view head,
                    std::string_view tail) {
  std::vector<std::string_view> pieces = {head};
  for (const auto& group : groups) pieces.insert(pieces.end(), group.begin(), group.end());
  pieces.push_back(tail);
  write_file(path, pieces);
  Hasher hasher;
  for (const std::string_view piece : pieces) hasher.add_raw(piece);
  return hasher.digest();
}

}  // namespace

Digest write_obj_like(const ObjFile& target, const Topology& topology, const Positions& positions,
                      const std::filesystem::path& path) {
  require_finite(positions, static_cast<Index>(target.vertex_spans.size()), path);
  const Positions normals = normals_by_index(target, topology, positions);
  const std::vector<Replacement> places = replacements(target, positions, normals);
  const std::string_view text = target.file.bytes();
  const auto end_of = [&](std::size_t i) { return places[i].span.begin + places[i].span.length; };
  // A block holds what stands before each of its places, then the new numbers.
  const auto blocks =
      format_blocks(static_cast<Index>(places.size()), [&](std::string& out, Index row) {
        const auto i = static_cast<std::size_t>(row);
        const Replacement& place = places[i];
        const std::uint64_t before = i == 0 ? 0 : end_of(i - 1);
        out += text.substr(before, place.span.begin - before);
        const std::string_view old = text.substr(place.span.begin, place.span.length);
        if (place.rows == &normals && normals.row(place.row).isZero(0)) {
          out += old;
        } else {
          append_like(out, old, *place.rows, place.row);
        }
      });
  return write_blocks(path, {blocks}, {}, text.substr(end_of(places.size() - 1)));
}

void write_obj(const Mesh& mesh, const std::string& comment, const std::filesystem::path& path) {
  const Topology& topology = mesh.topology;
  require_finite(mesh.positions, topology.vertex_count, path);
  const auto vertices = format_blocks(topology.vertex_count, [&](std::string& out, Index i) {
    out += "v ";
    append_row(out, mesh.positions, i);
    out += '\n';
  });
  const auto uvs = format_blocks(mesh.uvs.rows(), [&](std::string& out, Index i) {
    out += "vt ";
    append_single(out, mesh.uvs(i, 0));
    out += ' ';
    append_single(out, mesh.uvs(i, 1));
    out += '\n';
  });
  const auto faces = format_blocks(topology.face_count(), [&](std::string& out, Index f) {
    out += 'f';
    for (auto c = topology.face_offsets[static_cast<std::size_t>(f)];
         c < topology.face_offsets[static_cast<std::size_t>(f) + 1]; ++c) {
      out += concat(' ', topology.corner_vertices[c] + 1);
      if (!topology.corner_uvs.empty() && topology.corner_uvs[c] != kNoIndex) {
        out += concat('/', topology.corner_uvs[c] + 1);
      }
    }
    out += '\n';
  });
  const std::string head = comment.empty() ? std::string() : concat("# ", comment, '\n');
  write_blocks(path, {vertices, uvs, faces}, head, {});
}

}  // namespace crowdface
