// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <set>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/mesh_format.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/io/ply_template.h"
#include "crowdface/io/usda_template.h"
#include "crowdface/mesh/normals.h"
#include "crowdface/run/wrap_inputs.h"

#include "cli/commands.h"
#include "cli/common_options.h"

namespace crowdface::cli {
namespace {

namespace fs = std::filesystem;

struct ConvertOptions : CommonOptions {
  std::string in, out, units = "m", like;
  bool force = false;
};

GlbOptions materials_of(const FileMesh& mesh, const ConvertOptions& options) {
  GlbOptions written;
  written.unit = parse_unit("--units", options.units);
  written.has_colours = mesh.colours.rows() > 0;
  if (mesh.materials.empty()) return written;
  PolygonMaterials materials = polygon_materials(mesh.materials, mesh.topology.face_count());
  for (std::string& name : materials.names) written.materials.push_back({std::move(name)});
  written.polygon_materials = std::move(materials.material_of_polygon);
  return written;
}

void write_mesh(const FileMesh& mesh, MeshFormat format, const fs::path& out,
                const ConvertOptions& options) {
  const std::string name = out.stem().string();
  const auto normals = [&] { return vertex_normals(mesh.topology, mesh.positions); };
  const ColourRows colours = byte_colours(mesh.colours);
  switch (format) {
    case MeshFormat::kObj: {
      const std::string library = mesh.textures.empty()
                                      ? std::string()
                                      : write_mesh_textures(mesh, out.parent_path(), name);
      const EncodedFile plain = encode_obj(mesh, {}, mesh.materials, library);
      if (colours.rows() == 0) return plain.write(out);
      return EncodedFile(with_colours(plain.text(), colours)).write(out);
    }
    case MeshFormat::kPly: {
      const PlyTemplate form(mesh.topology);
      return form.encode(mesh.positions, {}, name, colours).write(out);
    }
    case MeshFormat::kGlb: {
      const GlbTemplate form(mesh.topology, mesh.uvs, materials_of(mesh, options));
      return form.encode(mesh.positions, normals(), name, {}, {}, {}, {}, {}, colours).write(out);
    }
    case MeshFormat::kUsd: {
      const UsdaTemplate form(mesh.topology, mesh.uvs, materials_of(mesh, options),
                              Subdivision::kNone);
      return form.encode(mesh.positions, normals(), name, {}, {}, {}, {}, colours).write(out);
    }
    case MeshFormat::kPoints:
      encode_npy(mesh.positions, name).write(out);
      write_topology_arrays(mesh.topology, mesh.uvs, {},
                            fs::absolute(out).parent_path() / "topology");
  }
}

/// Copies polygons, texture coordinates and materials from the mesh file `like` to `mesh`, which
/// has only positions.
void copy_polygons(const std::string& like, FileMesh& mesh) {
  FileMesh other = read_joined_mesh(like);
  if (other.positions.rows() != mesh.positions.rows()) {
    refuse_file(like,
                concat("the number of vertices differs from the number of positions: expected ",
                       mesh.positions.rows(), ", found ", other.positions.rows()));
  }
  mesh.topology = std::move(other.topology);
  mesh.uvs = std::move(other.uvs);
  mesh.materials = std::move(other.materials);
}

void convert(const ConvertOptions& options) {
  const auto format = mesh_format_of(options.out);
  if (!format) {
    throw UsageError(
        concat("--output: expected a name that ends in .obj, .ply, .glb, .usda or .npy, found ",
               quoted(options.out)));
  }
  const fs::path out = checked_output_path(options.out);
  refuse_to_write_over({options.in}, {out});
  const auto refuse_to_replace = [&](const fs::path& file) {
    if (options.force || !path_exists(file)) return;
    throw UsageError(concat(file.string(), ": already exists; use --force to replace it"));
  };
  refuse_to_replace(out);
  FileMesh mesh = read_joined_mesh(options.in);
  if (!mesh.textures.empty() && *format == MeshFormat::kObj) {
    refuse_to_replace(fs::path(out).replace_extension(".mtl"));
  }
  if (!options.like.empty()) copy_polygons(options.like, mesh);
  if (mesh.topology.face_count() == 0 && format != MeshFormat::kPoints) {
    refuse_file(options.in,
                concat("expected a mesh, found ", mesh.positions.rows(),
                       " points and no faces; use --like to name a mesh with the same vertices"));
  }
  for (const std::string& note : mesh.notes) log_warning(concat(options.in, ": ", note));
  if (!mesh.textures.empty() && *format != MeshFormat::kObj) {
    log_warning(
        concat(options.in, ": the textures are not converted; convert to OBJ to keep them"));
  }
  if (mesh.colours.rows() > 0 && *format == MeshFormat::kPoints) {
    log_warning(concat(options.in, ": the vertex colours are not converted"));
  }
  write_mesh(mesh, *format, out, options);
  log_info(concat(options.in, ": ", mesh.positions.rows(), " vertices and ",
                  mesh.topology.face_count(), " faces, written to ", out.string()));
}

void declare_convert(CLI::App& command, ConvertOptions& options) {
  add_option(command, "input", options.in, "IN",
             "A mesh: OBJ, PLY, STL, GLB, glTF, FBX, USD as text or NumPy")
      .required();
  add_option(command, "-o,--output", options.out, "OUT.{obj,ply,glb,usda,npy}", "The file to write")
      .required();
  add_option(command, "--units", options.units, "UNIT",
             "The length unit of the mesh, for GLB and USD");
  add_option(command, "--like", options.like, "MESH",
             "A mesh that provides the faces for an array of positions");
  add_flag(command, "--force", options.force, "Replace an existing file");
}

}  // namespace

CommandAction add_convert(CLI::App& program) {
  return add_command(program, "convert", "Convert a mesh to another format", declare_convert,
                     convert);
}

}  // namespace crowdface::cli
