// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/ply_template.h"

#include <algorithm>

#include "crowdface/core/file.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

/// \param small_polygons  whether no polygon has more than 255 corners. The file then stores each
///                        number of corners in one byte, the type that most readers support.
std::string ply_header(Index vertices, Index faces, bool with_normals, bool with_colours,
                       bool small_polygons) {
  return concat(
      "ply\nformat binary_little_endian 1.0\nelement vertex ", vertices,
      "\nproperty float x\nproperty float y\nproperty float z\n",
      with_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
      with_colours ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "",
      "element face ", faces,
      // Use "int" instead of "uint" for the indices, because all readers support "int".
      "\nproperty list ", small_polygons ? "uchar" : "uint", " int vertex_indices\nend_header\n");
}

std::size_t vertex_size(bool with_normals, bool with_colours) {
  return (with_normals ? 6 : 3) * sizeof(float) + (with_colours ? 3 : 0);
}

}  // namespace

PlyTemplate::PlyTemplate(const Topology& topology)
    : vertex_count_(topology.vertex_count), face_count_(topology.face_count()) {
  constexpr std::size_t kMaxByte = 255;
  for (Index f = 0; f < face_count_; ++f) {
    has_small_polygons_ = has_small_polygons_ && topology.face(f).size() <= kMaxByte;
  }
  encoded_polygons_.reserve(static_cast<std::size_t>(face_count_) *
                                (has_small_polygons_ ? 1 : sizeof(std::uint32_t)) +
                            topology.corner_vertices.size() * sizeof(std::uint32_t));
  for (Index f = 0; f < face_count_; ++f) {
    const auto face = topology.face(f);
    if (has_small_polygons_) {
      encoded_polygons_.push_back(static_cast<char>(face.size()));
    } else {
      append_number(encoded_polygons_, static_cast<std::uint32_t>(face.size()));
    }
    for (const std::uint32_t vertex : face) append_number(encoded_polygons_, vertex);
  }
}

std::size_t PlyTemplate::encoding_memory_bytes() const {
  return static_cast<std::size_t>(vertex_count_) * vertex_size(true, true);
}

EncodedFile PlyTemplate::encode(const Positions& positions, const Positions& normals,
                                const std::string& what, const ColourRows& colours) const {
  require_finite(positions, vertex_count_, what);
  const bool with_normals = normals.rows() > 0;
  if (with_normals) require_finite(normals, vertex_count_, what);
  const bool with_colours = colours.rows() > 0;
  require(!with_colours || colours.rows() == vertex_count_, "PlyTemplate: a colour of each vertex");
  const std::size_t size = vertex_size(with_normals, with_colours);
  EncodedFile file;
  file.add(ply_header(vertex_count_, face_count_, with_normals, with_colours, has_small_polygons_));
  char* vertices = file.reserve(static_cast<std::size_t>(vertex_count_) * size);
  parallel_blocks(vertex_count_, kRowsPerBlock, [&](Index begin, Index end) {
    char* out = vertices + static_cast<std::size_t>(begin) * size;
    for (Index i = begin; i < end; ++i) {
      out = put_row(out, positions, i);
      if (with_normals) out = put_row(out, normals, i);
      for (Index c = 0; with_colours && c < 3; ++c) out = put_number(out, colours(i, c));
    }
  });
  file.add_without_copy({vertices, static_cast<std::size_t>(vertex_count_) * size});
  file.add_without_copy(encoded_polygons_);
  return file;
}

Positions read_ply_positions(const std::filesystem::path& path) {
  const MappedFile file(path);
  const std::string_view bytes = file.bytes();
  const auto count_after = [&](std::string_view words) {
    const std::size_t at = std::min(bytes.find(words), bytes.size());
    const std::string_view rest = bytes.substr(std::min(at + words.size(), bytes.size()));
    return parse_unsigned(rest.substr(0, rest.find('\n'))).value_or(0);
  };
  const std::string_view head = bytes.substr(0, 1024);
  const bool with_normals = head.find("property float nx") != head.npos;
  const bool with_colours = head.find("property uchar red") != head.npos;
  const auto vertices = static_cast<Index>(count_after("element vertex "));
  const std::string header =
      ply_header(vertices, static_cast<Index>(count_after("element face ")), with_normals,
                 with_colours, head.find("list uint") == head.npos);
  const std::size_t size = vertex_size(with_normals, with_colours);
  if (!bytes.starts_with(header) ||
      static_cast<std::size_t>(vertices) > (bytes.size() - header.size()) / size) {
    refuse_file(path,
                "expected a PLY file as crowdface writes it, found different contents; run "
                "crowdface generate to write the file again");
  }
  return read_singles(bytes.data() + header.size(), vertices, size, path.string());
}

}  // namespace crowdface
