// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/unfold.h"

#include <algorithm>

#include "crowdface/core/interrupt.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/parts/vector3.h"
#include "crowdface/wrap/shape_fit.h"

namespace crowdface {
namespace {

constexpr int kMostRounds = 60;
constexpr int kSmoothings = 20;   ///< of a patch in each round
constexpr double kLeastArea = 0.02;

struct Neighbours {
  std::vector<std::uint32_t> offsets, vertices;

  explicit Neighbours(const SkinMesh& skin) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const Triangle& t : skin.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        pairs.emplace_back(t[k], t[(k + 1) % 3]);
        pairs.emplace_back(t[(k + 1) % 3], t[k]);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    offsets.assign(skin.vertices.size() + 1, 0);
    for (const auto& [from, to] : pairs) {
      ++offsets[from + 1];
      vertices.push_back(to);
    }
    for (std::size_t v = 1; v < offsets.size(); ++v) offsets[v] += offsets[v - 1];
  }
};

Eigen::Vector3d area_of(const Positions& positions, const Triangle& t) {
  const Eigen::Vector3d a = positions.row(t[0]).transpose();
  return cross3(positions.row(t[1]).transpose() - a, positions.row(t[2]).transpose() - a);
}

}  // namespace

std::vector<std::uint32_t> folded_triangles(const SkinMesh& skin, const Positions& rest,
                                            const Positions& positions) {
  const Positions before = skin_normals(skin, rest), after = skin_normals(skin, positions);
  const auto against = [](const Positions& normals, const Triangle& t, const Eigen::Vector3d& area) {
    const Eigen::Vector3d around =
        (normals.row(t[0]) + normals.row(t[1]) + normals.row(t[2])).transpose();
    return dot3(around, area) <= 0;
  };
  std::vector<std::uint32_t> folded;
  for (std::uint32_t i = 0; i < skin.triangles.size(); ++i) {
    const Triangle& t = skin.triangles[i];
    const Eigen::Vector3d was = area_of(rest, t), is = area_of(positions, t);
    if (was.isZero()) continue;
    const bool turned = dot3(was, is) <= 0, shrunk = length3(is) < kLeastArea * length3(was);
    const bool bent_back = against(after, t, is) && !against(before, t, was);
    if (turned || shrunk || bent_back) folded.push_back(i);
  }
  return folded;
}

Index unfold(const SkinMesh& skin, const Positions& rest, Positions& positions) {
  std::vector<std::uint32_t> folded = folded_triangles(skin, rest, positions);
  if (folded.empty()) return 0;
  const Neighbours around(skin);
  Positions displacements = positions - rest;
  // How many rings around a vertex a patch has grown; patches that do not mend grow.
  std::vector<int> rings(skin.triangles.size(), 0);
  for (int round = 0; round < kMostRounds && !folded.empty(); ++round) {
    throw_if_interrupted();
    std::vector<int> reach(skin.vertices.size(), 0);
    for (const std::uint32_t i : folded) {
      ++rings[i];
      for (const std::uint32_t v : skin.triangles[i]) {
        reach[v] = std::max(reach[v], 1 + rings[i] / 2);
      }
    }
    std::vector<std::uint32_t> patch;
    for (std::uint32_t v = 0; v < reach.size(); ++v) {
      if (reach[v] > 0) patch.push_back(v);
    }
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const std::uint32_t v = patch[i];
      for (std::uint32_t n = around.offsets[v]; n < around.offsets[v + 1]; ++n) {
        const std::uint32_t other = around.vertices[n];
        if (reach[other] >= reach[v] - 1) continue;
        if (reach[other] == 0) patch.push_back(other);
        reach[other] = reach[v] - 1;
      }
    }
    std::sort(patch.begin(), patch.end());
    for (int s = 0; s < kSmoothings; ++s) {
      for (const std::uint32_t v : patch) {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (std::uint32_t n = around.offsets[v]; n < around.offsets[v + 1]; ++n) {
          sum += displacements.row(around.vertices[n]);
        }
        displacements.row(v) = sum / (around.offsets[v + 1] - around.offsets[v]);
      }
    }
    positions = rest + displacements;
    folded = folded_triangles(skin, rest, positions);
  }
  return static_cast<Index>(folded.size());
}

}  // namespace crowdface
