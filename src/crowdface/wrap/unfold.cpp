// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/unfold.h"

#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/all_columns.h"
#include "crowdface/wrap/growing_patch.h"

namespace crowdface {
namespace {

constexpr double kMinArea = 0.025;  // the validity check counts triangles below 0.02

bool is_folded(const Positions& rest_positions, const Positions& positions, const Triangle& t) {
  const Eigen::Vector3d was = area_vector(rest_positions, t), is = area_vector(positions, t);
  if (was.isZero()) return false;
  return was.dot(is) <= 0 || is.norm() < kMinArea * was.norm();
}

}  // namespace

std::vector<std::uint32_t> folded_triangles(const SkinMesh& skin, const Positions& rest_positions,
                                            const Positions& positions) {
  std::vector<std::uint32_t> folded;
  for (std::uint32_t i = 0; i < skin.triangles.size(); ++i) {
    if (is_folded(rest_positions, positions, skin.triangles[i])) folded.push_back(i);
  }
  return folded;
}

Index repair_folded_triangles(const SkinMesh& skin, const Positions& rest_positions,
                              Positions& positions) {
  std::vector<std::uint32_t> folded = folded_triangles(skin, rest_positions, positions);
  if (folded.empty()) return 0;
  const PatchMender mender(skin, rest_positions);
  const auto is_bad = [&](const Triangle& t) { return is_folded(rest_positions, positions, t); };
  Positions as_it_was;
  const PatchChange lay{
      .make =
          [&](const GrowingPatch& patch) {
            const auto rows = patch.vertices();
            as_it_was = positions(rows, kAllColumns);
            const Positions of_rest = rest_positions(rows, kAllColumns);
            const Positions laid =
                fit_similarity(of_rest, as_it_was, ScaleFit::kUniform).apply(of_rest);
            for (std::size_t i = 0; i < rows.size(); ++i) {
              const auto row = static_cast<Index>(i);
              positions.row(rows[i]) += patch.weight(i) * (laid.row(row) - as_it_was.row(row));
            }
          },
      .undo =
          [&](const GrowingPatch& patch) { positions(patch.vertices(), kAllColumns) = as_it_was; }};
  for (std::size_t before = folded.size() + 1; folded.size() < before && !folded.empty();) {
    before = folded.size();
    mender.mend(folded, is_bad, lay);
    folded = folded_triangles(skin, rest_positions, positions);
  }
  return static_cast<Index>(folded.size());
}

}  // namespace crowdface
