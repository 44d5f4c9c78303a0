// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "crowdface/core/error.h"
#include "crowdface/io/file_mesh.h"

#include "fuzz/input_file.h"

namespace {

// A mesh's format is told by its name; here by how it begins.
crowdface::FileMesh parse(std::string_view bytes) {
  if (bytes.starts_with("ply")) return crowdface::parse_ply(bytes, "scan.ply");
  if (bytes.starts_with("glTF") || bytes.starts_with("{")) {
    return crowdface::parse_gltf(bytes, "scan.glb");
  }
  return crowdface::parse_stl(bytes, "scan.stl");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    crowdface::FileMesh mesh = parse(crowdface::fuzz::text_of(data, size));
    const auto check = [&] {
      const crowdface::Topology& topology = mesh.topology;
      if (topology.vertex_count != mesh.positions.rows()) std::abort();
      if (topology.face_offsets.back() != topology.corner_vertices.size()) std::abort();
      for (const std::uint32_t vertex : topology.corner_vertices) {
        if (static_cast<crowdface::Index>(vertex) >= topology.vertex_count) std::abort();
      }
      for (const std::uint32_t uv : topology.corner_uvs) {
        if (uv != crowdface::kNoIndex && uv >= mesh.uvs.rows()) std::abort();
      }
    };
    check();
    if (mesh.positions.allFinite()) crowdface::join_split_vertices(mesh);
    check();
  } catch (const crowdface::Error&) {
  }
  return 0;
}
