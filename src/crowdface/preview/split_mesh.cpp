// SPDX-License-Identifier: Apache-2.0
#include "crowdface/preview/split_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"

namespace crowdface {
namespace {

/// Returns, for each row, the index of the first row with equal coordinates. Needed because some
/// files repeat equal coordinates for every corner.
std::vector<std::uint32_t> first_equal_rows(const TextureCoordinates& uvs) {
  std::vector<std::uint32_t> order(static_cast<std::size_t>(uvs.rows()));
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t row) {
    return std::array<double, 2>{uvs(row, 0), uvs(row, 1)};
  };
  std::ranges::stable_sort(order,
                           [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && key(order[i - 1]) == key(order[i]);
    first[order[i]] = again ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// The texture tile (u and v rounded down) that contains the mean texture coordinate of a polygon;
/// (0, 0) if a corner has no texture coordinate.
std::array<double, 2> tile_of(std::span<const std::uint32_t> corners,
                              const TextureCoordinates& uvs) {
  Eigen::RowVector2d sum(0, 0);
  for (const std::uint32_t uv : corners) {
    if (uv == kNoIndex) return {};
    sum += uvs.row(uv);
  }
  if (corners.empty()) return {};
  sum /= static_cast<double>(corners.size());
  return {std::floor(sum.x()), std::floor(sum.y())};
}

}  // namespace

Positions SplitMesh::corner_positions(const Positions& whole) const {
  Positions positions(static_cast<Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    positions.row(static_cast<Index>(i)) = whole.row(corners[i].vertex);
  }
  return positions;
}

SplitMesh split_mesh(const Topology& topology, const TextureCoordinates& uvs,
                     std::span<const std::uint32_t> materials) {
  require(static_cast<Index>(materials.size()) == topology.face_count(),
          "split mesh: ", materials.size(), " materials, ", topology.face_count(), " faces");
  const std::vector<std::uint32_t> first_uv = first_equal_rows(uvs);
  SplitMesh split;
  std::map<std::pair<std::uint32_t, std::array<double, 2>>, std::uint32_t> known_materials;
  std::vector<SplitMesh::Corner> all;
  std::vector<std::uint32_t> face_of;  // the polygon of each corner in `all`
  for (Index f = 0; f < topology.face_count(); ++f) {
    if (materials[static_cast<std::size_t>(f)] == kNoIndex) continue;
    const auto rows = uvs.rows() > 0 ? topology.face_uvs(f) : std::span<const std::uint32_t>();
    const auto [material, is_new] = known_materials.emplace(
        std::pair(materials[static_cast<std::size_t>(f)], tile_of(rows, uvs)),
        static_cast<std::uint32_t>(known_materials.size()));
    if (is_new) split.first_face_of_material.push_back(static_cast<std::uint32_t>(f));
    const auto vertices = topology.face(f);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const bool has_uv = !rows.empty() && rows[k] != kNoIndex;
      all.push_back({vertices[k], has_uv ? first_uv[rows[k]] : kNoIndex, material->second});
      face_of.push_back(static_cast<std::uint32_t>(f));
    }
  }
  split.corners = all;
  std::sort(split.corners.begin(), split.corners.end());
  split.corners.erase(std::unique(split.corners.begin(), split.corners.end()), split.corners.end());
  std::vector<std::uint32_t> number(all.size());
  parallel_for_each(all.size(), 4096, [&](std::size_t c) {
    number[c] = static_cast<std::uint32_t>(
        std::lower_bound(split.corners.begin(), split.corners.end(), all[c]) -
        split.corners.begin());
  });
  split.face_of_corner.resize(split.corners.size());
  for (std::size_t c = all.size(); c-- > 0;) split.face_of_corner[number[c]] = face_of[c];
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && face_of[end] == face_of[begin]) ++end;
    for (std::size_t c = begin + 1; c + 1 < end; ++c) {
      split.triangles.push_back({number[begin], number[c], number[c + 1]});
    }
  }
  return split;
}

std::vector<Triangle> grouped_by_material(std::vector<Triangle> triangles, const SplitMesh& split) {
  std::erase_if(triangles, [&](const Triangle& t) {
    const auto vertex = [&](std::size_t k) { return split.corners[t[k]].vertex; };
    return vertex(0) == vertex(1) || vertex(1) == vertex(2) || vertex(2) == vertex(0);
  });
  std::ranges::stable_sort(triangles, {},
                           [&](const Triangle& t) { return split.corners[t[0]].material; });
  return triangles;
}

}  // namespace crowdface
