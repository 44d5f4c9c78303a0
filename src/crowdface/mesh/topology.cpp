// SPDX-License-Identifier: Apache-2.0
#include "crowdface/mesh/topology.h"

#include <algorithm>

#include "crowdface/core/parallel.h"
#include "crowdface/core/text.h"

namespace crowdface {
namespace {

/// Writes indices as text, counted from 1, such as "1 2 3 4". kNoIndex appears as "none".
std::string list_from_one(std::span<const std::uint32_t> indices) {
  std::string out;
  for (const std::uint32_t index : indices) {
    if (!out.empty()) out += ' ';
    out += index == kNoIndex ? std::string("none") : concat(index + 1);
  }
  return out;
}

}  // namespace

void Topology::add_face(std::span<const std::uint32_t> vertices,
                        std::span<const std::uint32_t> uvs) {
  corner_vertices.insert(corner_vertices.end(), vertices.begin(), vertices.end());
  corner_uvs.insert(corner_uvs.end(), uvs.begin(), uvs.end());
  face_offsets.push_back(static_cast<std::uint32_t>(corner_vertices.size()));
}

VertexFaces::VertexFaces(const Topology& topology) {
  const auto for_each_corner = [&](const auto& put) {
    for (Index f = 0; f < topology.face_count(); ++f) {
      for (const std::uint32_t v : topology.face(f)) put(v, static_cast<std::uint32_t>(f));
    }
  };
  CompressedRows<std::uint32_t>::operator=(compressed_rows<std::uint32_t>(
      static_cast<std::size_t>(topology.vertex_count), for_each_corner));
}

std::vector<std::uint32_t> renumber(std::span<std::uint32_t> indices, Index count) {
  std::vector<std::uint32_t> number(static_cast<std::size_t>(count), kNoIndex), used;
  for (const std::uint32_t i : indices) number[i] = 0;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] == kNoIndex) continue;
    number[i] = static_cast<std::uint32_t>(used.size());
    used.push_back(i);
  }
  for (std::uint32_t& i : indices) i = number[i];
  return used;
}

Positions mean_head(const HeadSet& head_set) {
  constexpr Index kBlock = 4096;
  Positions mean(head_set.topology.vertex_count, 3);
  parallel_blocks(mean.rows(), kBlock, [&](Index begin, Index end) {
    auto rows = mean.middleRows(begin, end - begin);
    rows.setZero();
    for (const Head& head : head_set.heads) rows += head.positions.middleRows(begin, end - begin);
    rows /= static_cast<double>(head_set.heads.size());
  });
  return mean;
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
  }
  if (expected.face_count() != found.face_count()) {
    return concat("expected ", expected.face_count(), " faces, found ", found.face_count());
  }
  return {};
}

}  // namespace crowdface
