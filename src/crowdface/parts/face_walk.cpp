// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/face_walk.h"

#include <queue>
#include <unordered_map>
#include <unordered_set>

namespace crowdface {
namespace {

/// Where a face runs through an edge: its corner at the edge's beginning.
struct FaceEdge {
  std::uint32_t face;
  std::size_t corner;
};

std::optional<FaceEdge> face_along(const Topology& topology, const FacesAround& around,
                                   DirectedEdge edge) {
  for (const std::uint32_t f : around.of(edge.from)) {
    const auto face = topology.face(f);
    for (std::size_t c = 0; c < face.size(); ++c) {
      if (face[c] == edge.from && face[(c + 1) % face.size()] == edge.to) return FaceEdge{f, c};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<MirroredPair>> walk_mirrored(const Topology& topology,
                                                       const FacesAround& around, DirectedEdge edge,
                                                       DirectedEdge other) {
  std::vector<MirroredPair> pairs;
  std::unordered_map<std::uint32_t, std::uint32_t> partner_of, vertex_of;
  std::unordered_set<std::uint32_t> met;
  std::queue<std::pair<FaceEdge, FaceEdge>> open;
  /// \return false if only one side has a face there
  const auto reach = [&](DirectedEdge here, DirectedEdge there) {
    const auto face = face_along(topology, around, here);
    const auto image = face_along(topology, around, there);
    if (face.has_value() != image.has_value()) return false;
    if (face && met.insert(face->face).second) open.emplace(*face, *image);
    return true;
  };
  if (!reach(edge, other) || open.empty()) return std::nullopt;
  while (!open.empty()) {
    const auto [at, at_image] = open.front();
    open.pop();
    const auto face = topology.face(at.face), image = topology.face(at_image.face);
    const std::size_t size = face.size();
    if (image.size() != size) return std::nullopt;
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t vertex = face[(at.corner + 1 + i) % size];
      const std::uint32_t partner = image[(at_image.corner + size - i) % size];
      const auto [known, is_new] = partner_of.emplace(vertex, partner);
      if (known->second != partner) return std::nullopt;
      if (vertex_of.emplace(partner, vertex).first->second != vertex) return std::nullopt;
      if (is_new) pairs.push_back({vertex, partner});
    }
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t from = face[i], to = face[(i + 1) % size];
      if (!reach({to, from}, {partner_of[from], partner_of[to]})) return std::nullopt;
    }
  }
  return pairs;
}

}  // namespace crowdface
