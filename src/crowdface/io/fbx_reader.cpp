// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/fbx_reader.h"

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/own_library.h"

namespace crowdface {

FileMesh parse_fbx(std::string_view bytes, const std::string& name) {
  static auto* const read = reinterpret_cast<ReadFbx*>(
      function_of_own_library("libcrowdface_meshes.so", "crowdface_read_fbx",
                              "FBX files need (Assimp)", "FBX files cannot be read"));
  FileMesh mesh;
  std::string error;
  if (!read(bytes, mesh, error)) {
    throw InvalidInput(concat(
        name, ": expected an FBX file that Assimp reads (FBX 2011 or later), found another: ",
        error, "; export it anew, or as OBJ or GLB"));
  }
  return mesh;
}

}  // namespace crowdface
