// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/unfold.h"

#include <algorithm>

#include "crowdface/core/interrupt.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr int kMostRounds = 140;
constexpr int kPatience = 60;  ///< rounds that mend nothing before the best so far is taken
constexpr int kSweeps = 10;    ///< over a patch in each round
constexpr int kRoundsPerRing = 8, kMostRings = 16;
constexpr int kRoundsInside = 30;
constexpr double kInside = 0.12;      ///< openness
constexpr double kLeastArea = 0.025;  // validity counts those below 0.02

/// One sweep over a patch that makes it as rigid as it can be (Sorkine & Alexa 2007): each vertex goes
/// where its neighbours, each with the template's edges turned as they lie around it, want it.
/// \param number  #skin: of each vertex in the patch, or kNoIndex.
void relax(const SkinMesh& skin, const Positions& rest, const std::vector<std::uint32_t>& patch,
           const std::vector<std::uint32_t>& number, Positions& positions) {
  std::vector<Eigen::Matrix3d> turns(patch.size());
  for (std::size_t i = 0; i < patch.size(); ++i) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const std::uint32_t n : skin.adjacency.of(patch[i])) {
      covariance += (positions.row(n) - positions.row(patch[i])).transpose() *
                    (rest.row(n) - rest.row(patch[i]));
    }
    turns[i] = best_rotation(covariance);
  }
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const std::uint32_t v = patch[i];
    const auto around = skin.adjacency.of(v);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t n : around) {
      const std::uint32_t other = number[n];
      const Eigen::Matrix3d turn = (turns[i] + (other == kNoIndex ? turns[i] : turns[other])) / 2;
      sum += positions.row(n).transpose() + turn * (rest.row(v) - rest.row(n)).transpose();
    }
    positions.row(v) = (sum / static_cast<double>(around.size())).transpose();
  }
}

bool is_folded(const Positions& rest, const Positions& positions, const Triangle& t) {
  const Eigen::Vector3d was = area_vector(rest, t), is = area_vector(positions, t);
  if (was.isZero()) return false;
  return dot3(was, is) <= 0 || length3(is) < kLeastArea * length3(was);
}

}  // namespace

std::vector<std::uint32_t> folded_triangles(const SkinMesh& skin, const Positions& rest,
                                            const Positions& positions) {
  std::vector<std::uint32_t> folded;
  for (std::uint32_t i = 0; i < skin.triangles.size(); ++i) {
    if (is_folded(rest, positions, skin.triangles[i])) folded.push_back(i);
  }
  return folded;
}

Index unfold(const SkinMesh& skin, const Positions& rest, Positions& positions) {
  std::vector<std::uint32_t> folded = folded_triangles(skin, rest, positions);
  if (folded.empty()) return 0;
  const auto inside = [&](std::uint32_t v) { return skin.openness[v] < kInside; };
  const FacesAround around(topology_of(skin.triangles, skin.vertex_count()));
  std::vector<int> rounds(skin.triangles.size(), 0);
  std::vector<int> reach(skin.vertices.size(), 0);
  std::vector<std::uint32_t> number(skin.vertices.size(), kNoIndex);
  Positions best = positions;
  std::size_t fewest = folded.size();
  for (int round = 0, since = 0; !folded.empty() && round < kMostRounds && since < kPatience;
       ++round, ++since) {
    throw_if_interrupted();
    std::vector<std::uint32_t> patch;
    for (const std::uint32_t i : folded) {
      ++rounds[i];
      for (const std::uint32_t v : skin.triangles[i]) {
        if (reach[v] == 0) patch.push_back(v);
        reach[v] = std::max(reach[v], std::min(1 + rounds[i] / kRoundsPerRing, kMostRings));
      }
    }
    std::sort(patch.begin(), patch.end());
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const std::uint32_t v = patch[i];
      for (const std::uint32_t other : skin.adjacency.of(v)) {
        if (reach[other] >= reach[v] - 1) continue;
        // Inside mouth and sockets there is more to give: what is seen comes last.
        if (round < kRoundsInside && inside(v) && !inside(other)) continue;
        if (reach[other] == 0) patch.push_back(other);
        reach[other] = reach[v] - 1;
      }
    }
    std::sort(patch.begin(), patch.end());
    for (std::uint32_t i = 0; i < patch.size(); ++i) number[patch[i]] = i;
    for (int s = 0; s < kSweeps; ++s) relax(skin, rest, patch, number, positions);
    folded.clear();
    for (const std::uint32_t v : patch) {
      for (const std::uint32_t i : around.of(v)) {
        if (is_folded(rest, positions, skin.triangles[i])) folded.push_back(i);
      }
      number[v] = kNoIndex;
      reach[v] = 0;
    }
    std::sort(folded.begin(), folded.end());
    folded.erase(std::unique(folded.begin(), folded.end()), folded.end());
    if (folded.size() >= fewest) continue;
    fewest = folded.size();
    best = positions;
    since = 0;
  }
  positions = best;
  return static_cast<Index>(fewest);
}

}  // namespace crowdface
