// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/obj_writer.h"

#include <functional>
#include <map>
#include <vector>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"
#include "crowdface/io/obj_template.h"
#include "crowdface/io/single_precision.h"
#include "crowdface/io/single_text.h"

namespace crowdface {
namespace {

constexpr Index kLinesPerBlock = 8192;

void append_single(std::string& out, double value) {
  char buffer[kSingleRoom];
  out.append(buffer, write_single(buffer, value));
}

void append_row(std::string& out, const Positions& rows, Index i) {
  for (Index c = 0; c < 3; ++c) {
    if (c > 0) out += ' ';
    append_single(out, rows(i, c));
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

void add_blocks(EncodedFile& file, const std::vector<std::string>& blocks) {
  for (const std::string& block : blocks) file.add(block);
}

}  // namespace

Digest write_obj_like(const ObjFile& target, const Topology& topology, const Positions& positions,
                      const std::filesystem::path& path) {
  const EncodedFile file = ObjTemplate(target, topology).encode(positions, path.string());
  file.write(path);
  return file.digest();
}

EncodedFile encode_obj(const Mesh& mesh, const std::string& comment,
                       const std::vector<MaterialRange>& materials, const std::string& library) {
  const Topology& topology = mesh.topology;
  std::map<Index, std::string> material_lines;
  for (const MaterialRange& range : materials) {
    material_lines[range.first_face] += concat("usemtl ", range.name, '\n');
  }
  require_finite(mesh.positions, topology.vertex_count, comment);
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
    if (const auto line = material_lines.find(f); line != material_lines.end()) out += line->second;
    out += 'f';
    const auto [begin, end] = topology.corners(f);
    for (auto c = begin; c < end; ++c) {
      out += concat(' ', topology.corner_vertices[c] + 1);
      if (!topology.corner_uvs.empty() && topology.corner_uvs[c] != kNoIndex) {
        out += concat('/', topology.corner_uvs[c] + 1);
      }
    }
    out += '\n';
  });
  EncodedFile file;
  if (!comment.empty()) file.add(concat("# ", comment, '\n'));
  if (!library.empty()) file.add(concat("mtllib ", library, '\n'));
  add_blocks(file, vertices);
  add_blocks(file, uvs);
  add_blocks(file, faces);
  return file;
}

}  // namespace crowdface
