// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/mesh_as_obj.h"

#include <algorithm>
#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/obj_colours.h"
#include "crowdface/io/obj_writer.h"
#include "crowdface/io/outward_polygons.h"
#include "crowdface/io/read_mesh.h"

namespace crowdface {

bool is_obj(const std::filesystem::path& path) {
  return lower_case(path.extension().string()) == ".obj";
}

bool is_head_file(const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  const std::string name = lower_case(path.stem().string());
  const bool is_faces = name == "faces" || name == "triangles" || name == "quads";
  return !(is_faces && ending == ".npy") && ending != ".stl" &&
         std::ranges::find(mesh_extensions(), ending) != mesh_extensions().end();
}

ObjFile convert_to_obj(FileMesh mesh, const std::filesystem::path& path,
                       const std::string& library) {
  if (mesh.topology.face_count() == 0) {
    refuse_file(path,
                concat("expected a mesh, found ", mesh.positions.rows(), " points and no face"));
  }
  for (MaterialRange& material : mesh.materials) {
    material.name = material_name_of(std::move(material.name));
  }
  std::string encoded = encode_obj(mesh, {}, mesh.materials, library).text();
  if (mesh.colours.rows() > 0) {
    encoded = with_colours(encoded, byte_colours(mesh.colours));
  }
  MappedFile text = MappedFile::from_text(std::move(encoded));
  const ObjSummary summary = summarise_obj(text.bytes());
  ObjFile file = read_obj(path, std::move(text), summary);
  file.notes = std::move(mesh.notes);
  file.is_mended = true;
  return file;
}

FileMesh read_joined_mesh(const std::filesystem::path& path) {
  FileMesh mesh = read_mesh(path);
  for (Index v = 0; v < mesh.positions.rows(); ++v) {
    if (mesh.positions.row(v).allFinite()) continue;
    refuse_file(path, concat("expected finite positions, found ", mesh.positions(v, 0), ' ',
                             mesh.positions(v, 1), ' ', mesh.positions(v, 2), " at vertex ", v + 1,
                             ": remove this vertex from all heads"));
  }
  join_split_vertices(mesh);
  return mesh;
}

ObjFile read_mesh_as_obj(const std::filesystem::path& path) {
  ObjFile file = with_outward_faces(is_obj(path) ? read_obj(path)
                                                 : convert_to_obj(read_joined_mesh(path), path));
  if (file.has_reversed_faces) file.notes.emplace_back(kReversedFacesNote);
  return file;
}

}  // namespace crowdface
