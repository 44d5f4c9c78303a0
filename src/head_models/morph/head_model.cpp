// SPDX-License-Identifier: Apache-2.0
#include "head_models/morph/head_model.h"

#include <algorithm>

#include "crowdface/core/error.h"

namespace crowdface {

std::vector<std::uint32_t> vertices_of_material(const Topology& topology,
                                                const std::vector<MaterialRange>& materials,
                                                const std::vector<std::string>& words) {
  std::vector<std::uint32_t> rows;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const auto named = [&](const std::string& word) {
      return materials[m].name.find(word) != std::string::npos;
    };
    if (std::ranges::none_of(words, named)) continue;
    const Index end =
        m + 1 < materials.size() ? materials[m + 1].first_face : topology.face_count();
    for (Index f = materials[m].first_face; f < end; ++f) {
      rows.insert(rows.end(), topology.face(f).begin(), topology.face(f).end());
    }
  }
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

Eigen::RowVector3d mean_of(const Positions& positions, const std::vector<std::uint32_t>& rows) {
  if (rows.empty()) throw InvalidInput("expected vertices to take the mean of, found none");
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (const std::uint32_t row : rows) sum += positions.row(row);
  return sum / static_cast<double>(rows.size());
}

}  // namespace crowdface
