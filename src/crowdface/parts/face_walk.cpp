// SPDX-License-Identifier: Apache-2.0
#include "crowdface/parts/face_walk.h"

#include <span>
#include <utility>

#include "crowdface/core/interrupt.h"

namespace crowdface {

MirroredWalk::MirroredWalk(const Topology& topology, const VertexFaces& around)
    : topology_(topology),
      around_(around),
      partner_of_(static_cast<std::size_t>(topology.vertex_count), kNoIndex),
      vertex_of_(partner_of_),
      met_(static_cast<std::size_t>(topology.face_count()), false) {}

std::optional<MirroredWalk::FaceEdge> MirroredWalk::face_along(DirectedEdge edge) const {
  for (const std::uint32_t f : around_.of(edge.from)) {
    const auto face = topology_.face(f);
    for (std::size_t c = 0; c < face.size(); ++c) {
      const std::size_t next = c + 1 == face.size() ? 0 : c + 1;
      if (face[c] == edge.from && face[next] == edge.to) return FaceEdge{f, c};
    }
  }
  return std::nullopt;
}

/// \return  false if only one side has a face there.
bool MirroredWalk::reach(DirectedEdge here, DirectedEdge there) {
  const auto face = face_along(here);
  const auto image = face_along(there);
  if (face.has_value() != image.has_value()) return false;
  if (!face || met_[face->face]) return true;
  met_[face->face] = true;
  faces_.push_back({*face, *image});
  return true;
}

/// \return  false if either vertex already has another partner.
bool MirroredWalk::pair(MirroredPair pair) {
  std::uint32_t& partner = partner_of_[pair.vertex];
  if (partner != kNoIndex) return partner == pair.partner;
  if (vertex_of_[pair.partner] != kNoIndex) return false;
  partner = pair.partner;
  vertex_of_[pair.partner] = pair.vertex;
  pairs_.push_back(pair);
  return true;
}

bool MirroredWalk::pair_corners(const FacePair& faces,
                                const std::function<bool(const MirroredPair&)>& goes_on) {
  const auto face = topology_.face(faces.here.face), image = topology_.face(faces.there.face);
  const std::size_t size = face.size(), known = pairs_.size();
  if (image.size() != size) return false;
  for (std::size_t i = 0; i < size; ++i) {
    if (!pair({face[(faces.here.corner + 1 + i) % size],
               image[(faces.there.corner + size - i) % size]})) {
      return false;
    }
  }
  for (std::size_t p = known; p < pairs_.size(); ++p) {
    if (!goes_on(pairs_[p])) return false;
  }
  return true;
}

bool MirroredWalk::go(DirectedEdge edge, DirectedEdge other,
                      const std::function<bool(const MirroredPair&)>& goes_on) {
  if (!reach(edge, other) || faces_.empty()) return false;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (f % 4096 == 0) throw_if_interrupted();
    if (!pair_corners(FacePair(faces_[f]), goes_on)) return false;
    const auto face = topology_.face(faces_[f].here.face);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t from = face[i], to = face[(i + 1) % face.size()];
      if (!reach({to, from}, {partner_of_[from], partner_of_[to]})) return false;
    }
  }
  return true;
}

void MirroredWalk::forget() {
  for (const auto [vertex, partner] : pairs_) {
    partner_of_[vertex] = kNoIndex;
    vertex_of_[partner] = kNoIndex;
  }
  for (const FacePair& faces : faces_) met_[faces.here.face] = false;
  pairs_.clear();
  faces_.clear();
}

std::optional<std::vector<MirroredPair>> MirroredWalk::from(
    DirectedEdge edge, DirectedEdge other,
    const std::function<bool(const MirroredPair&)>& goes_on) {
  std::optional<std::vector<MirroredPair>> result;
  if (go(edge, other, goes_on)) result = pairs_;
  forget();
  return result;
}

}  // namespace crowdface
