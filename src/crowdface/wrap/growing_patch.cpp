// SPDX-License-Identifier: Apache-2.0
#include "crowdface/wrap/growing_patch.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/interrupt.h"

namespace crowdface {
namespace {

constexpr double kMaxPatchMm = 15;
constexpr double kMinRings = 12, kMaxRings = 100;

}  // namespace

GrowingPatch::GrowingPatch(const SkinMesh& skin, const Triangle& triangle)
    : skin_(skin),
      vertices_(triangle.begin(), triangle.end()),
      rings_(vertices_.size(), 0),
      is_member_(skin.vertices.size(), false) {
  for (const std::uint32_t v : vertices_) is_member_[v] = true;
}

void GrowingPatch::grow() {
  ++ring_count_;
  for (std::size_t i = 0, known = vertices_.size(); i < known; ++i) {
    if (rings_[i] < ring_count_ - 1) continue;
    for (const std::uint32_t n : skin_.adjacency.items_of(vertices_[i])) {
      if (is_member_[n]) continue;
      is_member_[n] = true;
      vertices_.push_back(n);
      rings_.push_back(ring_count_);
    }
  }
}

PatchMender::PatchMender(const SkinMesh& skin, const Positions& rest_positions)
    : skin_(skin), triangles_of_vertex_(topology_of(skin.triangles, skin.vertex_count())) {
  double area = 0;
  for (const Triangle& t : skin.triangles) area += area_vector(rest_positions, t).norm();
  const double edge = std::sqrt(area / static_cast<double>(skin.triangles.size()));
  max_rings_ = static_cast<int>(std::clamp(kMaxPatchMm / edge, kMinRings, kMaxRings));
}

void PatchMender::mend(std::span<const std::uint32_t> triangles,
                       const std::function<bool(const Triangle&)>& is_bad,
                       const PatchChange& change) const {
  for (const std::uint32_t t : triangles) {
    throw_if_interrupted();
    if (is_bad(skin_.triangles[t])) mend_around(skin_.triangles[t], is_bad, change);
  }
}

void PatchMender::mend_around(const Triangle& triangle,
                              const std::function<bool(const Triangle&)>& is_bad,
                              const PatchChange& change) const {
  GrowingPatch patch(skin_, triangle);
  const auto count_bad = [&] {
    std::vector<std::uint32_t> bad;
    for (const std::uint32_t v : patch.vertices()) {
      for (const std::uint32_t t : triangles_of_vertex_.items_of(v)) {
        if (is_bad(skin_.triangles[t])) bad.push_back(t);
      }
    }
    std::ranges::sort(bad);
    return std::unique(bad.begin(), bad.end()) - bad.begin();
  };
  for (int ring = 0; ring < max_rings_; ++ring) {
    patch.grow();
    const auto before = count_bad();
    for (const double steepness : {1.0, 2.0, 4.0}) {
      patch.set_weight_steepness(steepness);
      change.make(patch);
      if (count_bad() < before) return;
      change.undo(patch);
    }
  }
}

}  // namespace crowdface
