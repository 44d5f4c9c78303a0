// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/mesh_format.h"

#include <array>
#include <utility>

#include "crowdface/core/text.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/io/ply_template.h"
#include "crowdface/io/usda_template.h"
#include "crowdface/mesh/normals.h"

namespace crowdface {

namespace {

namespace fs = std::filesystem;

/// Options with the materials of a mesh that was read from a file.
GlbOptions options_of(const FileMesh& mesh, LengthUnit unit) {
  GlbOptions options;
  options.unit = unit;
  options.has_colours = mesh.colours.rows() > 0;
  if (mesh.materials.empty()) return options;
  PolygonMaterials materials = polygon_materials(mesh.materials, mesh.topology.face_count());
  for (std::string& name : materials.names) options.materials.push_back({std::move(name)});
  options.polygon_materials = std::move(materials.material_of_polygon);
  return options;
}

/// Writes an OBJ file, and beside it the textures and a material file that names the textures.
void write_obj_mesh(const FileMesh& mesh, LengthUnit, const fs::path& file) {
  const std::string library =
      mesh.textures.empty() ? std::string()
                            : write_mesh_textures(mesh, file.parent_path(), file.stem().string());
  const EncodedFile plain = encode_obj(mesh, {}, mesh.materials, library);
  if (mesh.colours.rows() == 0) return plain.write(file);
  EncodedFile(with_colours(plain.text(), byte_colours(mesh.colours))).write(file);
}

void write_ply_mesh(const FileMesh& mesh, LengthUnit, const fs::path& file) {
  const PlyTemplate form(mesh.topology);
  const ColourRows colours = byte_colours(mesh.colours);
  form.encode(mesh.positions, {}, file.stem().string(), colours).write(file);
}

void write_glb_mesh(const FileMesh& mesh, LengthUnit unit, const fs::path& file) {
  const GlbTemplate form(mesh.topology, mesh.uvs, options_of(mesh, unit));
  const Positions normals = vertex_normals(mesh.topology, mesh.positions);
  const ColourRows colours = byte_colours(mesh.colours);
  form.encode(mesh.positions, normals, file.stem().string(), {}, {}, {}, {}, {}, colours)
      .write(file);
}

/// Writes the positions to `file` and the polygons to the folder `topology` beside it.
void write_npy_mesh(const FileMesh& mesh, LengthUnit, const fs::path& file) {
  encode_npy(mesh.positions, file.stem().string()).write(file);
  write_topology_arrays(mesh.topology, mesh.uvs, {}, fs::absolute(file).parent_path() / "topology");
}

void write_usda_mesh(const FileMesh& mesh, LengthUnit unit, const fs::path& file) {
  const UsdaTemplate form(mesh.topology, mesh.uvs, options_of(mesh, unit), Subdivision::kNone);
  const Positions normals = vertex_normals(mesh.topology, mesh.positions);
  const ColourRows colours = byte_colours(mesh.colours);
  form.encode(mesh.positions, normals, file.stem().string(), {}, {}, {}, {}, colours).write(file);
}

// One entry per format. An entry lists the values of the members of MeshFormatTraits in order.
constexpr std::array<MeshFormatTraits, kMeshFormatCount> kTraits = {
    {{MeshFormat::kObj, "obj", ".obj", "mesh", true, true, FileNormals::kReducedLevels,
      DataStorage::kOwnFiles, DataStorage::kOwnFiles, DataStorage::kOwnFiles,
      [](const fs::path& file, Index) { return read_obj(file).positions; }, write_obj_mesh},
     {MeshFormat::kPly, "ply", ".ply", "ply", true, false, FileNormals::kLikeTarget,
      DataStorage::kNowhere, DataStorage::kOwnFiles, DataStorage::kNowhere,
      [](const fs::path& file, Index) { return read_ply_positions(file); }, write_ply_mesh},
     {MeshFormat::kGlb, "glb", ".glb", "glb", true, false, FileNormals::kAlways,
      DataStorage::kInside, DataStorage::kInside, DataStorage::kInside, read_glb_positions,
      write_glb_mesh},
     {MeshFormat::kPoints, "points", ".npy", "points", false, false, FileNormals::kNone,
      DataStorage::kOneFile, DataStorage::kNowhere, DataStorage::kNowhere,
      [](const fs::path& file, Index) { return read_npy(file); }, write_npy_mesh},
     {MeshFormat::kUsd, "usd", ".usda", "usd", true, false, FileNormals::kAlways,
      DataStorage::kInside, DataStorage::kInside, DataStorage::kOwnFiles, read_usda_positions,
      write_usda_mesh}}};

constexpr bool are_rows_complete() {
  for (std::size_t f = 0; f < kTraits.size(); ++f) {
    const MeshFormatTraits& row = kTraits[f];
    if (row.format != static_cast<MeshFormat>(f) || row.name.empty() || row.write == nullptr)
      return false;
  }
  return true;
}
static_assert(are_rows_complete(), "every MeshFormat has its row, in the enumeration's order");

}  // namespace

const MeshFormatTraits& traits_of(MeshFormat format) {
  return kTraits[static_cast<std::size_t>(format)];
}

const std::vector<MeshFormat>& all_mesh_formats() {
  static const std::vector<MeshFormat> all = [] {
    std::vector<MeshFormat> formats;
    for (const MeshFormatTraits& traits : kTraits) formats.push_back(traits.format);
    return formats;
  }();
  return all;
}

std::string list_of_extensions() {
  std::string list;
  for (const MeshFormatTraits& traits : kTraits) {
    const bool is_last = traits.format == kTraits.back().format;
    list += concat(list.empty() ? "" : is_last ? " or " : ", ", traits.extension);
  }
  return list;
}

std::optional<MeshFormat> mesh_format_of(const fs::path& file) {
  const std::string extension = lower_case(file.extension().string());
  for (const MeshFormatTraits& traits : kTraits) {
    if (extension == traits.extension) return traits.format;
  }
  return std::nullopt;
}

}  // namespace crowdface
