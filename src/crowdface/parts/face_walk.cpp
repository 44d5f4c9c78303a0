// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/face_walk.h"

#include <span>
#include <utility>

#include "crowdface/core/interrupt.h"

namespace crowdface {

MirroredWalk::MirroredWalk(const Topology& topology, const VertexFaces& vertex_faces)
    : topology_(topology),
      vertex_faces_(vertex_faces),
      partner_of_vertex_(static_cast<std::size_t>(topology.vertex_count), kNoIndex),
      vertex_of_partner_(partner_of_vertex_),
      is_visited_(static_cast<std::size_t>(topology.face_count()), false) {}

std::optional<MirroredWalk::FaceEdge> MirroredWalk::face_along(DirectedEdge edge) const {
  for (const std::uint32_t f : vertex_faces_.items_of(edge.from)) {
    const auto face = topology_.face(f);
    for (std::size_t c = 0; c < face.size(); ++c) {
      const std::size_t next = c + 1 == face.size() ? 0 : c + 1;
      if (face[c] == edge.from && face[next] == edge.to) return FaceEdge{f, c};
    }
  }
  return std::nullopt;
}

bool MirroredWalk::visit_faces(DirectedEdge here, DirectedEdge there) {
  const auto face = face_along(here);
  const auto image = face_along(there);
  if (face.has_value() != image.has_value()) return false;
  if (!face || is_visited_[face->face]) return true;
  is_visited_[face->face] = true;
  faces_.push_back({*face, *image});
  return true;
}

bool MirroredWalk::add_pair(MirroredPair pair) {
  std::uint32_t& partner = partner_of_vertex_[pair.vertex];
  if (partner != kNoIndex) return partner == pair.partner;
  if (vertex_of_partner_[pair.partner] != kNoIndex) return false;
  partner = pair.partner;
  vertex_of_partner_[pair.partner] = pair.vertex;
  pairs_.push_back(pair);
  return true;
}

bool MirroredWalk::pair_corners(const FaceEdgePair& faces,
                                const std::function<bool(const MirroredPair&)>& may_continue) {
  const auto face = topology_.face(faces.here.face), image = topology_.face(faces.there.face);
  const std::size_t size = face.size(), known = pairs_.size();
  if (image.size() != size) return false;
  for (std::size_t i = 0; i < size; ++i) {
    if (!add_pair({face[(faces.here.corner + 1 + i) % size],
                   image[(faces.there.corner + size - i) % size]})) {
      return false;
    }
  }
  for (std::size_t p = known; p < pairs_.size(); ++p) {
    if (!may_continue(pairs_[p])) return false;
  }
  return true;
}

bool MirroredWalk::walk(DirectedEdge edge, DirectedEdge other,
                        const std::function<bool(const MirroredPair&)>& may_continue) {
  if (!visit_faces(edge, other) || faces_.empty()) return false;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (f % 4096 == 0) throw_if_interrupted();
    if (!pair_corners(FaceEdgePair(faces_[f]), may_continue)) return false;
    const auto face = topology_.face(faces_[f].here.face);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t from = face[i], to = face[(i + 1) % face.size()];
      if (!visit_faces({to, from}, {partner_of_vertex_[from], partner_of_vertex_[to]}))
        return false;
    }
  }
  return true;
}

void MirroredWalk::reset() {
  for (const auto [vertex, partner] : pairs_) {
    partner_of_vertex_[vertex] = kNoIndex;
    vertex_of_partner_[partner] = kNoIndex;
  }
  for (const FaceEdgePair& faces : faces_) is_visited_[faces.here.face] = false;
  pairs_.clear();
  faces_.clear();
}

std::optional<std::vector<MirroredPair>> MirroredWalk::walk_from(
    DirectedEdge edge, DirectedEdge other,
    const std::function<bool(const MirroredPair&)>& may_continue) {
  std::optional<std::vector<MirroredPair>> result;
  if (walk(edge, other, may_continue)) result = pairs_;
  reset();
  return result;
}

}  // namespace crowdface
