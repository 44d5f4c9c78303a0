// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/plain_obj_template.h"

#include <functional>
#include <map>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/single_precision.h"

namespace crowdface {
namespace {

constexpr Index kLinesPerBlock = 8192;
/// Length of the longest line, which is "vn " followed by three numbers with separators.
constexpr std::size_t kLongestLine = 3 + 3 * (kMaxFloatTextLength + 1);

void append_single(std::string& out, double value) {
  char buffer[kMaxFloatTextLength];
  out.append(buffer, write_single(buffer, value));
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

void add_rows(EncodedFile& file, const char* word, const Positions& rows) {
  for (const std::string& block : format_blocks(rows.rows(), [&](std::string&out, Index i) {
         out += word;
         for (Index c = 0; c < 3; ++c) {
           out += ' ';
           append_single(out, rows(i, c));
         }
         out += '\n';
       })) {
    file.add(block);
  }
}

std::string uv_lines(const TextureCoordinates& uvs) {
  return join(format_blocks(uvs.rows(),
                            [&](std::string& out, Index i) {
                              out += "vt ";
                              append_single(out, uvs(i, 0));
                              out += ' ';
                              append_single(out, uvs(i, 1));
                              out += '\n';
                            }),
              "");
}

std::string face_lines(const Topology& topology, const std::vector<MaterialRange>& materials,
                       bool normals) {
  std::map<Index, std::string> material_lines;
  for (const MaterialRange& range : materials) {
    material_lines[range.first_face] += concat("usemtl ", range.name, '\n');
  }
  const auto append_corner = [&](std::string& out, std::uint32_t corner) {
    const std::uint32_t vertex = topology.corner_vertices[corner] + 1;
    const bool has_uv = !topology.corner_uvs.empty() && topology.corner_uvs[corner] != kNoIndex;
    out += ' ';
    out += std::to_string(vertex);
    if (has_uv || normals) out += '/';
    if (has_uv) out += std::to_string(topology.corner_uvs[corner] + 1);
    if (!normals) return;
    out += '/';
    out += std::to_string(vertex);
  };
  return join(format_blocks(topology.face_count(),
                            [&](std::string& out, Index f) {
                              if (const auto line = material_lines.find(f);
                                  line != material_lines.end()) {
                                out += line->second;
                              }
                              out += 'f';
                              const auto [begin, end] = topology.corners(f);
                              for (auto c = begin; c < end; ++c) append_corner(out, c);
                              out += '\n';
                            }),
              "");
}

}  // namespace

PlainObjTemplate::PlainObjTemplate(const Topology& topology, const TextureCoordinates& uvs,
                                   const std::vector<MaterialRange>& materials, Normals normals)
    : vertex_count_(topology.vertex_count),
      normals_(normals),
      shared_text_(uv_lines(uvs) + face_lines(topology, materials, normals == Normals::kVertex)) {}

EncodedFile PlainObjTemplate::encode(const std::string& header, const Positions& positions,
                                     const Positions& normals, const std::string& what) const {
  require_finite(positions, vertex_count_, what);
  EncodedFile file;
  if (!header.empty()) file.add(header);
  add_rows(file, "v", positions);
  if (normals_ == Normals::kVertex) {
    require_finite(normals, vertex_count_, what);
    add_rows(file, "vn", normals);
  }
  file.add_without_copy(shared_text_);
  return file;
}

std::size_t PlainObjTemplate::encoding_memory_bytes() const {
  const std::size_t lines = normals_ == Normals::kVertex ? 2 : 1;
  return lines * static_cast<std::size_t>(vertex_count_) * kLongestLine;
}

}  // namespace crowdface
