// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/fbx_reader.h"

#include <utility>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/mesh_textures.h"
#include "crowdface/io/project_library.h"

namespace crowdface {

FileMesh parse_fbx(std::string_view bytes, const std::filesystem::path& path) {
  static auto* const read = reinterpret_cast<ReadFbx*>(
      load_library_function("libcrowdface_meshes.so", "crowdface_read_fbx",
                            "FBX files need (Assimp)", "FBX files cannot be read"));
  // Assimp 5.2 writes out of bounds if the base64 text of an image ends in more padding characters
  // than base64 allows.
  if (!bytes.starts_with("Kaydara FBX") && bytes.find("===") != bytes.npos) {
    throw InvalidInput(concat(path.string(),
                              ": expected embedded images as base64, found other text: export "
                              "binary FBX, or do not embed media"));
  }
  FileMesh mesh;
  std::vector<std::string> external_textures;
  std::string error;
  if (!read(bytes, mesh, external_textures, error)) {
    throw InvalidInput(concat(
        path.string(),
        ": expected an FBX file that Assimp reads (FBX 2011 or later), found another: ", error,
        "; export it again, or as OBJ or GLB"));
  }
  if (mesh.positions.rows() == 0 && !mesh.notes.empty()) {
    refuse_file(path,
                concat("expected a mesh that is shown, found none; ", join(mesh.notes, "; ")));
  }
  read_texture_files(std::move(external_textures), path, mesh);
  return mesh;
}

}  // namespace crowdface
