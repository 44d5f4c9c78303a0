// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/topology.h"

#include <algorithm>

#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// "1 2 3 4", counted from 1; "none" stands for a corner without index.
std::string list_from_one(std::span<const std::uint32_t> indices) {
  std::string out;
  for (const std::uint32_t index : indices) {
    if (!out.empty()) out += ' ';
    out += index == kNoIndex ? std::string("none") : concat(index + 1);
  }
  return out;
}

std::span<const std::uint32_t> uvs_of_face(const Topology& topology, Index f) {
  if (topology.corner_uvs.empty()) return {};
  const auto begin = topology.face_offsets[static_cast<std::size_t>(f)];
  const auto end = topology.face_offsets[static_cast<std::size_t>(f) + 1];
  return {topology.corner_uvs.data() + begin, end - begin};
}

}  // namespace

Positions mean_head(const FaceSet& faces) {
  Positions mean = Positions::Zero(faces.topology.vertex_count, 3);
  for (const Head& head : faces.heads) mean += head.positions;
  return mean / static_cast<double>(faces.heads.size());
}

std::string first_difference(const Topology& expected, const Topology& found) {
  if (expected.vertex_count != found.vertex_count) {
    return concat("expected ", expected.vertex_count, " vertices, found ", found.vertex_count);
  }
  const Index faces = std::min(expected.face_count(), found.face_count());
  for (Index f = 0; f < faces; ++f) {
    const auto a = expected.face(f), b = found.face(f);
    if (!std::ranges::equal(a, b)) {
      return concat("face ", f + 1, ": expected vertices ", list_from_one(a), ", found ",
                    list_from_one(b));
    }
    const auto ua = uvs_of_face(expected, f), ub = uvs_of_face(found, f);
    if (!std::ranges::equal(ua, ub)) {
      return concat("face ", f + 1, ": expected texture coordinates ", list_from_one(ua),
                    ", found ", ub.empty() ? std::string("none") : list_from_one(ub));
    }
  }
  if (expected.face_count() != found.face_count()) {
    return concat("expected ", expected.face_count(), " faces, found ", found.face_count());
  }
  return {};
}

}  // namespace crowdface
