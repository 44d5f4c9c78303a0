// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "crowdface/core/file.h"
#include "crowdface/io/obj_scan.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// An OBJ file as read: its mesh, and its text, which stays mapped, so that it can be written again
/// with other positions and nothing else changed.
struct ObjFile {
  std::filesystem::path path;
  MappedFile file;
  Topology topology;       ///< quads and n-gons kept, vertex order kept
  Positions positions;     ///< #V by 3, in file units
  TextureCoordinates uvs;  ///< #T by 2
  /// #C rows of `vn` or kNoIndex; empty if no `vn`
  std::vector<std::uint32_t> corner_normals;
  std::vector<std::string> material_libraries;
  std::vector<MaterialRange> materials;
  std::vector<MaterialRange> groups;
  std::vector<std::string> notes;     ///< what was mended or passed over, a sentence each
  bool is_mended = false;             ///< the text is not the file's own
  std::filesystem::path textures_at;  ///< what material files lie beside if it is not `path`

  const std::filesystem::path& material_path() const {
    return textures_at.empty() ? path : textures_at;
  }
};

/// Reads an OBJ file through tinyobjloader, behind a strict scan of its text (see scan_obj), which is mended where it
/// does not pass (see mend_obj).
/// \throws MissingInput, or InvalidInput naming file, line, what was expected and what was found.
ObjFile read_obj(const std::filesystem::path& path);
/// \param file     what is at the path, mapped.
/// \param outline  of its text
ObjFile read_obj(const std::filesystem::path& path, MappedFile file, const ObjOutline& outline);

/// The same without its mesh, which is that of a text that was read before: topology, texture coordinates and
/// corner normals are left empty.
/// \param outline  of the text; its `mesh` is that of the other, too.
ObjFile read_obj_beside(const std::filesystem::path& path, MappedFile file,
                        const ObjOutline& outline);

/// Which face is of which material.
struct FaceMaterials {
  std::vector<std::string>
      names;  ///< each once, as faces first have them; empty where none is named
  std::vector<std::uint32_t> of_face;  ///< #F, rows of `names`
};

/// \param ranges  an OBJ file's materials
FaceMaterials face_materials(const std::vector<MaterialRange>& ranges, Index face_count);

}  // namespace crowdface
