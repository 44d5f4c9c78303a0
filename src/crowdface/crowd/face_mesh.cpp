// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/face_mesh.h"

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"
#include "crowdface/io/glb_template.h"
#include "crowdface/io/npy.h"
#include "crowdface/io/obj_file.h"
#include "crowdface/io/ply_template.h"
#include "crowdface/io/usda_template.h"

namespace crowdface {

Positions read_face(const CrowdDirectory& directory, const std::string& id,
                    const std::vector<MeshFormat>& formats, Index vertices) {
  if (formats.empty()) {
    throw MissingInput(concat(directory.meshes().string(), ": this crowd has no meshes"));
  }
  const MeshFormat format = formats.front();
  const std::filesystem::path path = directory.mesh(id, format);
  Positions positions = [&] {
    switch (format) {
      case MeshFormat::kObj:
        return read_obj(path).positions;
      case MeshFormat::kPly:
        return read_ply_positions(path);
      case MeshFormat::kGlb:
        return read_glb_positions(path, vertices);
      case MeshFormat::kUsd:
        return read_usda_positions(path, vertices);
      case MeshFormat::kPoints:
        break;
    }
    return read_npy(path);
  }();
  if (positions.rows() != vertices) {
    refuse_file(path, concat("expected ", vertices, " vertices, found ", positions.rows()));
  }
  return positions;
}

}  // namespace crowdface
