// SPDX-License-Identifier: Apache-2.0
// Masks with a row of weights for each vertex.
#include <cstdlib>

#include "crowdface/core/error.h"
#include "crowdface/region/vertex_weights.h"

#include "fuzz/input_file.h"
#include "fuzz/job_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::fuzz::JobFolder folder("weights");
  for (const char* name : {"mask.npy", "mask.csv"}) {
    const auto file = folder.write(name, crowdface::fuzz::text_of(data, size));
    try {
      const crowdface::VertexWeights weights = crowdface::read_vertex_weights(file);
      if (weights.rows.rows() * weights.rows.width() != weights.rows.values.size()) std::abort();
      if (!weights.names.empty() && weights.names.size() != weights.rows.width()) std::abort();
      for (const double value : weights.rows.values) {
        if (!(value >= 0)) std::abort();
      }
    } catch (const crowdface::Error&) {
    }
  }
  return 0;
}
