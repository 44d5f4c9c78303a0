// SPDX-License-Identifier: Apache-2.0
#include "crowdface/io/glb_targets.h"

namespace crowdface {

GlbTargetRows target_rows(const GlbTarget& target, std::span<const std::uint32_t> split,
                          Index count) {
  std::vector<std::uint32_t> row_of(static_cast<std::size_t>(count), kNoIndex);
  for (std::uint32_t row = 0; row < target.vertices.size(); ++row) {
    row_of[target.vertices[row]] = row;
  }
  GlbTargetRows rows;
  rows.whole = target.vertices.size() == row_of.size();
  for (std::uint32_t i = 0; i < split.size(); ++i) {
    if (row_of[split[i]] == kNoIndex) continue;
    rows.rows.push_back(row_of[split[i]]);
    rows.vertices.push_back(i);
  }
  return rows;
}

std::pair<Eigen::RowVector3d, Eigen::RowVector3d> target_bounds(const Displacements& moves,
                                                                bool whole) {
  Eigen::RowVector3d least = Eigen::RowVector3d::Zero(), most = least;
  if (moves.moves.rows() == 0) return {least, most};
  least = moves.moves.colwise().minCoeff();
  most = moves.moves.colwise().maxCoeff();
  if (whole) return {least, most};
  return {least.cwiseMin(0), most.cwiseMax(0)};
}

}  // namespace crowdface
