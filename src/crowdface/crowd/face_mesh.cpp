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
  Positions positions;
  switch (format) {
    case MeshFormat::kObj:
      positions = read_obj(path).positions;
      break;
    case MeshFormat::kPly:
      positions = read_ply_positions(path);
      break;
    case MeshFormat::kGlb:
      positions = read_glb_positions(path, vertices);
      break;
    case MeshFormat::kUsd:
      positions = read_usda_positions(path, vertices);
      break;
    case MeshFormat::kPoints:
      positions = read_npy(path);
      break;
  }
  if (positions.rows() != vertices) {
    throw InvalidInput(
        concat(path.string(), ": expected ", vertices, " vertices, found ", positions.rows()));
  }
  return positions;
}

}  // namespace crowdface
