// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "crowdface/core/error.h"
#include "crowdface/io/obj_file.h"

#include "fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const crowdface::fuzz::InputFile file(data, size);
  try {
    const crowdface::ObjFile mesh = crowdface::read_obj(file.path());
    // What is accepted must be usable.
    if (!mesh.positions.allFinite()) std::abort();
    for (const std::uint32_t vertex : mesh.topology.corner_vertices) {
      if (static_cast<crowdface::Index>(vertex) >= mesh.topology.vertex_count) std::abort();
    }
  } catch (const crowdface::Error&) {
  }
  return 0;
}
