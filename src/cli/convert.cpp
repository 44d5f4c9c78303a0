// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>

#include "crowdface/core/error.h"
#include "crowdface/core/file.h"
#include "crowdface/core/log.h"
#include "crowdface/core/output_file.h"
#include "crowdface/core/text.h"
#include "crowdface/io/mesh_as_obj.h"
#include "crowdface/io/mesh_format.h"
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
  const MeshFormatTraits& format = traits_of(parse_mesh_output(options.out));
  const LengthUnit unit = parse_unit("--units", options.units);
  const fs::path out = checked_output_path(options.out);
  refuse_to_write_over({options.in}, {out});
  const auto refuse_to_replace = [&](const fs::path& file) {
    if (options.force || !path_exists(file)) return;
    throw UsageError(concat(file.string(), ": already exists; use --force to replace it"));
  };
  refuse_to_replace(out);
  FileMesh mesh = read_joined_mesh(options.in);
  if (!mesh.textures.empty() && format.has_material_file) {
    refuse_to_replace(fs::path(out).replace_extension(".mtl"));
  }
  if (!options.like.empty()) copy_polygons(options.like, mesh);
  if (mesh.topology.face_count() == 0 && format.has_polygons) {
    refuse_file(options.in,
                concat("expected a mesh, found ", mesh.positions.rows(),
                       " points and no faces; use --like to name a mesh with the same vertices"));
  }
  for (const std::string& note : mesh.notes) log_warning(concat(options.in, ": ", note));
  if (!mesh.textures.empty() && !format.has_material_file) {
    log_warning(
        concat(options.in, ": the textures are not converted; convert to OBJ to keep them"));
  }
  if (mesh.colours.rows() > 0 && !format.has_polygons) {
    log_warning(concat(options.in, ": the vertex colours are not converted"));
  }
  format.write(mesh, unit, out);
  log_info(concat(options.in, ": ", mesh.positions.rows(), " vertices and ",
                  mesh.topology.face_count(), " faces, written to ", out.string()));
}

void declare_convert(CLI::App& command, ConvertOptions& options) {
  add_option(command, "input", options.in, "IN",
             "A mesh: OBJ, PLY, STL, GLB, glTF, FBX, USD as text or NumPy")
      .required();
  add_mesh_output(command, options.out);
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
