// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/unfold.h"

#include <algorithm>

#include "crowdface/core/interrupt.h"
#include "crowdface/mesh/alignment.h"
#include "crowdface/mesh/vector3.h"

namespace crowdface {
namespace {

constexpr int kMostRings = 16;
constexpr double kLeastArea = 0.025;  // validity counts those below 0.02

bool is_folded(const Positions& rest, const Positions& positions, const Triangle& t) {
  const Eigen::Vector3d was = area_vector(rest, t), is = area_vector(positions, t);
  if (was.isZero()) return false;
  return dot3(was, is) <= 0 || length3(is) < kLeastArea * length3(was);
}

class Unfolding {
 public:
  Unfolding(const SkinMesh& skin, const Positions& rest, Positions& positions)
      : skin_(skin),
        around_(topology_of(skin.triangles, skin.vertex_count())),
        rest_(rest),
        positions_(positions) {}

  /// Lays a patch around a triangle as the template is, less and less towards its rim: the smallest that leaves
  /// fewer folded.
  void lay(const Triangle& triangle) {
    std::vector<std::uint32_t> patch(triangle.begin(), triangle.end());
    std::vector<int> rings(patch.size(), 0);
    std::vector<bool> is_in(skin_.vertices.size(), false);
    for (const std::uint32_t v : patch) is_in[v] = true;
    for (int ring = 1; ring <= kMostRings; ++ring) {
      for (std::size_t i = 0, known = patch.size(); i < known; ++i) {
        for (const std::uint32_t n : skin_.adjacency.of(patch[i])) {
          if (is_in[n]) continue;
          is_in[n] = true;
          patch.push_back(n);
          rings.push_back(ring);
        }
      }
      if (lay(patch, rings, ring)) return;
    }
  }

 private:
  bool lay(std::span<const std::uint32_t> patch, std::span<const int> rings, int ring) {
    Positions from(static_cast<Index>(patch.size()), 3), to(from.rows(), 3);
    for (std::size_t i = 0; i < patch.size(); ++i) {
      from.row(static_cast<Index>(i)) = rest_.row(patch[i]);
      to.row(static_cast<Index>(i)) = positions_.row(patch[i]);
    }
    const Positions laid = fit_similarity(from, to, ScaleFit::kUniform).apply(from);
    const std::size_t before = count_folded(patch);
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const auto row = static_cast<Index>(i);
      positions_.row(patch[i]) += (1 - rings[i] / (ring + 1.0)) * (laid.row(row) - to.row(row));
    }
    if (count_folded(patch) < before) return true;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      positions_.row(patch[i]) = to.row(static_cast<Index>(i));
    }
    return false;
  }

  /// Of triangles at these vertices.
  std::size_t count_folded(std::span<const std::uint32_t> vertices) const {
    std::vector<std::uint32_t> folded;
    for (const std::uint32_t v : vertices) {
      for (const std::uint32_t i : around_.of(v)) {
        if (is_folded(rest_, positions_, skin_.triangles[i])) folded.push_back(i);
      }
    }
    std::ranges::sort(folded);
    return static_cast<std::size_t>(std::unique(folded.begin(), folded.end()) - folded.begin());
  }

  const SkinMesh& skin_;
  FacesAround around_;
  const Positions& rest_;
  Positions& positions_;
};

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
  const std::vector<std::uint32_t> folded = folded_triangles(skin, rest, positions);
  if (folded.empty()) return 0;
  Unfolding unfolding(skin, rest, positions);
  for (const std::uint32_t i : folded) {
    throw_if_interrupted();
    if (is_folded(rest, positions, skin.triangles[i])) unfolding.lay(skin.triangles[i]);
  }
  return static_cast<Index>(folded_triangles(skin, rest, positions).size());
}

}  // namespace crowdface
