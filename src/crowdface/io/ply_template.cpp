// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/ply_template.h"

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/little_endian.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

constexpr Index kRowsPerBlock = 1 << 15;

char* put_row(char* out, const Positions& rows, Index i) {
  for (Index c = 0; c < 3; ++c) out = put_number(out, to_single(rows(i, c)));
  return out;
}

std::size_t vertex_size(bool with_normals) {
  return (with_normals ? 6 : 3) * sizeof(float);
}

}  // namespace

PlyTemplate::PlyTemplate(const Topology& topology)
    : vertices_(topology.vertex_count), face_count_(topology.face_count()) {
  faces_.reserve(static_cast<std::size_t>(face_count_) +
                 topology.corner_vertices.size() * sizeof(std::uint32_t));
  for (Index f = 0; f < face_count_; ++f) {
    const auto face = topology.face(f);
    constexpr std::size_t kMostCorners = 255;
    if (face.size() > kMostCorners) {
      throw InvalidInput(concat("PLY: expected faces of at most 255 corners, found one of ",
                                face.size(), ", face ", f + 1));
    }
    append_number(faces_, static_cast<std::uint8_t>(face.size()));
    for (const std::uint32_t vertex : face) append_number(faces_, vertex);
  }
}

std::string PlyTemplate::header(bool with_normals) const {
  return concat("ply\nformat binary_little_endian 1.0\nelement vertex ", vertices_,
                "\nproperty float x\nproperty float y\nproperty float z\n",
                with_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
                "element face ", face_count_,
                // "int" and not "uint": what readers have always met
                "\nproperty list uchar int vertex_indices\nend_header\n");
}

std::size_t PlyTemplate::encode_bytes(Normals normals) const {
  return static_cast<std::size_t>(vertices_) * vertex_size(normals == Normals::kVertex);
}

EncodedFile PlyTemplate::encode(const Positions& positions, const Positions& normals,
                                const std::string& what) const {
  require_finite(positions, vertices_, what);
  const bool with_normals = normals.rows() > 0;
  if (with_normals) require_finite(normals, vertices_, what);
  const std::size_t size = vertex_size(with_normals);
  EncodedFile file;
  file.add(header(with_normals));
  char* vertices = file.reserve(static_cast<std::size_t>(vertices_) * size);
  parallel_blocks(vertices_, kRowsPerBlock, [&](Index begin, Index end) {
    char* out = vertices + static_cast<std::size_t>(begin) * size;
    for (Index i = begin; i < end; ++i) {
      out = put_row(out, positions, i);
      if (with_normals) out = put_row(out, normals, i);
    }
  });
  file.refer_to({vertices, static_cast<std::size_t>(vertices_) * size});
  file.refer_to(faces_);
  return file;
}

}  // namespace crowdface
