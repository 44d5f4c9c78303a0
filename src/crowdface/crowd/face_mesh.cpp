// SPDX-License-Identifier: Apache-2.0
#include "crowdface/crowd/face_mesh.h"

#include <algorithm>

#include "crowdface/core/error.h"
#include "crowdface/core/text.h"

namespace crowdface {

Positions read_face_positions(const CrowdDirectory& directory, const std::string& id,
                              const std::vector<MeshFormat>& formats, Index vertices) {
  const auto format =
      std::ranges::find_if(formats, [](MeshFormat one) { return traits_of(one).read != nullptr; });
  if (format == formats.end()) {
    throw MissingInput(concat(directory.meshes().string(), ": this crowd has no meshes",
                              formats.empty() ? "" : " that crowdface can read",
                              "; add obj to output.meshes and run crowdface generate"));
  }
  const std::filesystem::path path = directory.mesh(id, *format);
  Positions positions = traits_of(*format).read(path, vertices);
  if (positions.rows() != vertices) {
    refuse_file(path, concat("expected ", vertices, " vertices, found ", positions.rows()));
  }
  return positions;
}

}  // namespace crowdface
