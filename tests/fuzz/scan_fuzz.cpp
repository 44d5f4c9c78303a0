// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <string_view>

#include "crowdface/core/error.h"
#include "crowdface/io/fbx_reader.h"
#include "crowdface/io/file_mesh.h"
#include "crowdface/io/npy_array.h"
#include "crowdface/io/obj_colours.h"

#include "fuzz/input_file.h"

namespace {

// Colours of an OBJ text at its vertices, as many as it has `v` lines.
crowdface::FileMesh coloured(std::string_view text) {
  crowdface::FileMesh mesh;
  const auto painted = crowdface::move_polypaint_to_vertices(text);
  const std::string_view lines = painted ? std::string_view(*painted) : text;
  for (const crowdface::Index vertices : {1, 4, 8}) {
    const auto colours = crowdface::obj_colours(lines, vertices);
    if (colours.rows() == 0) continue;
    if (colours.rows() != vertices) std::abort();
    crowdface::with_colours(lines, colours);
  }
  return mesh;
}

// A mesh's format is told by its name; here by how it begins.
crowdface::FileMesh parse(std::string_view bytes) {
  if (bytes.starts_with("ply")) return crowdface::parse_ply(bytes, "scan.ply");
  if (bytes.starts_with("glTF") || bytes.starts_with("{")) {
    return crowdface::parse_gltf(bytes, "scan.glb");
  }
  if (bytes.starts_with("#usda")) return crowdface::parse_usda(bytes, "scan.usda");
  if (bytes.starts_with("Kaydara") || bytes.starts_with("; FBX")) {
    return crowdface::parse_fbx(bytes, "scan.fbx");
  }
  if (bytes.starts_with("\x93NUMPY")) {
    crowdface::parse_npy(bytes, "scan.npy");
    return {};
  }
  if (bytes.starts_with("v ") || bytes.starts_with("#MRGB")) return coloured(bytes);
  return crowdface::parse_stl(bytes, "scan.stl");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    crowdface::FileMesh mesh = parse(crowdface::fuzz::text_of(data, size));
    const auto check = [&] {
      const crowdface::Topology& topology = mesh.topology;
      if (topology.vertex_count != mesh.positions.rows()) std::abort();
      if (mesh.colours.rows() > 0 && mesh.colours.rows() != mesh.positions.rows()) std::abort();
      if (!((mesh.colours.array() >= 0) && (mesh.colours.array() <= 1)).all()) std::abort();
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
