// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/read_mesh.h"

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/input_limits.h"
#include "crowdface/core/text.h"
#include "crowdface/io/fbx_reader.h"
#include "crowdface/io/foreign_file.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/npy_array.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/io/obj_file.h"

namespace crowdface {
namespace {

namespace fs = std::filesystem;

FileMesh mesh_of_obj(ObjFile file) {
  FileMesh mesh;
  const fs::path unnamed = find_unnamed_texture(file.path, file.file.bytes());
  const auto painted = move_polypaint_to_vertices(file.file.bytes());
  mesh.colours =
      colour_fractions(obj_colours(painted ? *painted : file.file.bytes(), file.positions.rows()));
  mesh.topology = std::move(file.topology);
  mesh.positions = std::move(file.positions);
  mesh.uvs = std::move(file.uvs);
  mesh.materials = std::move(file.materials);
  mesh.material_libraries = std::move(file.material_libraries);
  mesh.notes = std::move(file.notes);
  if (unnamed.empty()) return mesh;
  mesh.notes.push_back(concat("it names no material file; ", quoted(unnamed.filename().string()),
                              " beside it is used"));
  if (is_material_file(unnamed)) {
    mesh.material_libraries.push_back(unnamed.filename().string());
  } else {
    mesh.textures = colour_textures(unnamed, mesh.materials);
  }
  return mesh;
}

Index rows_of(const NpyArray& array) {
  return static_cast<Index>(array.rows());
}

/// Reads polygons stored beside an array of positions. The polygons are either in the files that
/// crowdface writes (topology/corners.npy, offsets.npy, …) or in one array of triangles or quads.
/// Leaves the mesh without polygons if none of these files exists.
void read_faces_beside(const fs::path& folder, FileMesh& mesh) {
  Topology& topology = mesh.topology;
  const auto index_of = [&](double number, Index rows, const fs::path& file) {
    if (number >= 0 && number < static_cast<double>(rows))
      return static_cast<std::uint32_t>(number);
    refuse_file(file, concat("expected numbers from 0 to ", rows - 1, ", found ", number));
  };
  const fs::path corners = folder / "topology" / kTopologyArrays[0];
  const fs::path offsets = folder / "topology" / kTopologyArrays[1];
  if (is_file(corners) && is_file(offsets)) {
    for (const double v : read_npy_array(corners).values) {
      topology.corner_vertices.push_back(index_of(v, mesh.positions.rows(), corners));
    }
    topology.face_offsets.clear();
    for (const double offset : read_npy_array(offsets).values) {
      const auto end = index_of(offset, topology.corner_count() + 1, offsets);
      if (!topology.face_offsets.empty() && end < topology.face_offsets.back() + 3) {
        refuse_file(offsets, "expected faces of at least 3 corners, found a smaller one");
      }
      topology.face_offsets.push_back(end);
    }
    if (topology.face_offsets.empty() || topology.face_offsets[0] != 0 ||
        topology.face_offsets.back() != topology.corner_vertices.size()) {
      refuse_file(offsets,
                  concat("expected face offsets that cover all corners of ", corners.string()));
    }
    const fs::path uvs = folder / "topology" / kTopologyArrays[2];
    const fs::path corner_uvs = folder / "topology" / kTopologyArrays[3];
    if (!is_file(uvs) || !is_file(corner_uvs)) return;
    const NpyArray rows = read_npy_array(uvs);
    if (rows.width() != 2)
      refuse_file(uvs, concat("expected two numbers per row, found ", rows.width()));
    mesh.uvs = Eigen::Map<const TextureCoordinates>(rows.values.data(), rows_of(rows), 2);
    for (const double row : read_npy_array(corner_uvs).values) {
      topology.corner_uvs.push_back(row == -1 ? kNoIndex
                                              : index_of(row, mesh.uvs.rows(), corner_uvs));
    }
    if (topology.corner_uvs.size() != topology.corner_vertices.size()) {
      refuse_file(corner_uvs, concat("expected ", topology.corner_vertices.size(), " rows, found ",
                                     topology.corner_uvs.size()));
    }
    return;
  }
  for (const char* name : {"faces.npy", "triangles.npy", "quads.npy"}) {
    const fs::path file = folder / name;
    if (!is_file(file)) continue;
    const NpyArray faces = read_npy_array(file);
    const bool sound = faces.shape.size() == 2 && (faces.width() == 3 || faces.width() == 4);
    if (!sound)
      refuse_file(
          file,
          "expected an array of n by 3 or n by 4 vertex numbers, found an array of another shape");
    for (std::size_t f = 0; f < faces.rows(); ++f) {
      for (std::size_t c = 0; c < faces.width(); ++c) {
        topology.corner_vertices.push_back(
            index_of(faces.values[f * faces.width() + c], mesh.positions.rows(), file));
      }
      topology.face_offsets.push_back(static_cast<std::uint32_t>(topology.corner_vertices.size()));
    }
    return;
  }
}

/// Reads positions, and polygons if the folder has a file of polygons.
FileMesh mesh_of_npy(std::string_view bytes, const fs::path& path) {
  const NpyArray array = parse_npy(bytes, path.string());
  const bool is_list = array.shape.size() == 3 && array.shape[0] != 1;
  if (is_list) {
    refuse_file(path, concat("expected the positions of one head (n by 3), found ", array.shape[0],
                             " heads: save each head to its own file"));
  }
  const std::size_t width = array.shape.empty() ? 0 : array.shape.back();
  if (width != 3 || array.shape.size() < 2) {
    std::string shape;
    for (const std::size_t size : array.shape) shape += concat(shape.empty() ? "" : " by ", size);
    refuse_file(
        path, concat("expected positions (n by 3), found an array of ", shape,
                     array.shape.size() == 2 && array.shape[0] == 3 ? ": save its transpose" : ""));
  }
  FileMesh mesh;
  const auto rows = static_cast<Index>(array.values.size() / 3);
  mesh.positions = Eigen::Map<const Positions>(array.values.data(), rows, 3);
  mesh.topology.vertex_count = rows;
  read_faces_beside(path.parent_path(), mesh);
  return mesh;
}

/// The usual extension of the file's format. The first bytes determine the format; if they match no
/// known format, the file's own extension determines it.
std::string format_extension(std::string_view bytes, const fs::path& path) {
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return ".ply";
  if (bytes.starts_with("glTF")) return ".glb";
  if (bytes.starts_with("Kaydara FBX")) return ".fbx";
  if (bytes.starts_with("\x93NUMPY")) return ".npy";
  if (bytes.starts_with("#usda")) return ".usda";
  return lower_case(path.extension().string());
}

void require_limits(const FileMesh& mesh, const fs::path& path) {
  const InputLimits& limits = input_limits();
  const auto vertices = static_cast<std::uint64_t>(mesh.positions.rows());
  const auto faces = static_cast<std::uint64_t>(mesh.topology.face_count());
  if (vertices <= limits.vertices && faces <= limits.faces) return;
  refuse_file(path, concat("expected at most ", limits.vertices, " vertices and ", limits.faces,
                           " faces (--limit), found ", vertices, " and ", faces));
}

}  // namespace

const std::vector<std::string_view>& mesh_extensions() {
  static const std::vector<std::string_view> endings = {
      ".obj", ".ply", ".stl", ".glb", ".gltf", ".fbx", ".npy", ".usda", ".usd", ".usdc", ".usdz"};
  return endings;
}

FileMesh read_mesh(const fs::path& path) {
  const MappedFile file(path);
  const std::string kind = format_extension(file.bytes(), path);
  if (kind != ".obj") refuse_non_mesh_file(file.bytes(), path);
  FileMesh mesh;
  if (kind == ".obj") {
    mesh = mesh_of_obj(read_obj(path));
  } else if (kind == ".ply") {
    mesh = parse_ply(file.bytes(), path.string());
  } else if (kind == ".stl") {
    mesh = parse_stl(file.bytes(), path.string());
  } else if (kind == ".glb" || kind == ".gltf") {
    mesh = parse_gltf(file.bytes(), path);
  } else if (kind == ".fbx") {
    mesh = parse_fbx(file.bytes(), path);
  } else if (kind == ".usda" || kind == ".usd") {
    mesh = parse_usda(file.bytes(), path.string());
  } else if (kind == ".npy") {
    mesh = mesh_of_npy(file.bytes(), path);
  } else {
    std::vector<std::string> endings(mesh_extensions().begin(), mesh_extensions().end());
    refuse_file(path, concat("expected a mesh whose name ends in ", join(endings)));
  }
  if (mesh.positions.rows() == 0) {
    refuse_file(path, "expected a mesh, found none: select the head, and export it as polygons");
  }
  require_limits(mesh, path);
  return mesh;
}

}  // namespace crowdface
