// SPDX-License-Identifier: Apache-2.0
// The file of the key `points`.
#include <cstdlib>
#include <vector>

#include "crowdface/core/problems.h"
#include "crowdface/heads/load_transferred.h"

#include "fuzz/input_file.h"
#include "fuzz/job_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const crowdface::fuzz::JobFolder folder("points");
  crowdface::Config config;
  config.points = folder.write("points.yaml", crowdface::fuzz::text_of(data, size));
  config.shapes.neutral = folder.write("neutral.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  crowdface::Inputs inputs;
  crowdface::Topology& topology = inputs.head_set.topology;
  topology.vertex_count = 3;
  topology.add_face(std::vector<std::uint32_t>{0, 1, 2});
  for (const char* name : {"ann", "bob"}) {
    inputs.head_set.heads.push_back({name, crowdface::Positions::Identity(3, 3)});
  }
  crowdface::Problems problems;
  crowdface::load_points(config, inputs, problems);
  if (!problems.empty()) return 0;
  const auto points = static_cast<crowdface::Index>(inputs.points.names.size());
  if (inputs.points.positions.size() != inputs.points.meshes.size()) std::abort();
  for (const crowdface::Positions& rows : inputs.points.positions) {
    if (rows.rows() != points || !rows.allFinite()) std::abort();
  }
  return 0;
}
