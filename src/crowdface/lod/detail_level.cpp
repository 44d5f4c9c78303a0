// SPDX-License-Identifier: Apache-2.0
#include "crowdface/lod/detail_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/preview/reduced_mesh.h"

namespace crowdface {
namespace {

/// Of rows that hold the same coordinates, the first: a file may write one a corner.
std::vector<std::uint32_t> first_of_equal(const TextureCoordinates& uvs) {
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

/// The tile of the texture that a face lies in.
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

/// The whole mesh as triangles whose vertices are split wherever texture or look change.
struct SplitMesh {
  struct Corner {
    std::uint32_t vertex, uv, look;
    auto operator<=>(const Corner&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  std::vector<Corner> corners;  ///< each once
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> face_of_look;  ///< the first of each
};

SplitMesh split_mesh(const FaceSet& faces, std::span<const std::uint32_t> looks) {
  const Topology& topology = faces.topology;
  const std::vector<std::uint32_t> first_uv = first_of_equal(faces.uvs);
  SplitMesh split;
  std::map<std::pair<std::uint32_t, std::array<double, 2>>, std::uint32_t> known_looks;
  std::vector<SplitMesh::Corner> all;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto uvs = topology.face_uvs(f);
    const auto [look, is_new] =
        known_looks.emplace(std::pair(looks[static_cast<std::size_t>(f)], tile_of(uvs, faces.uvs)),
                            static_cast<std::uint32_t>(known_looks.size()));
    if (is_new) split.face_of_look.push_back(static_cast<std::uint32_t>(f));
    const auto vertices = topology.face(f);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const bool has_uv = !uvs.empty() && uvs[k] != kNoIndex;
      all.push_back({vertices[k], has_uv ? first_uv[uvs[k]] : kNoIndex, look->second});
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
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto [begin, end] = topology.corners(f);
    for (std::uint32_t c = begin + 1; c + 1 < end; ++c) {
      split.triangles.push_back({number[begin], number[c], number[c + 1]});
    }
  }
  return split;
}

Positions rows_of(const Positions& whole, std::span<const std::uint32_t> rows) {
  Positions some(static_cast<Index>(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    some.row(static_cast<Index>(i)) = whole.row(rows[i]);
  }
  return some;
}

DetailLevel level_of(const SplitMesh& split, std::vector<Triangle> triangles,
                     const FaceSet& faces) {
  std::erase_if(triangles, [&](const Triangle& t) {  // collapsed along a seam
    const auto vertex = [&](std::size_t k) { return split.corners[t[k]].vertex; };
    return vertex(0) == vertex(1) || vertex(1) == vertex(2) || vertex(2) == vertex(0);
  });
  const auto look_of = [&](const Triangle& t) { return split.corners[t[0]].look; };
  std::ranges::stable_sort(
      triangles, [&](const Triangle& a, const Triangle& b) { return look_of(a) < look_of(b); });
  DetailLevel level;
  std::vector<std::uint32_t> vertices, uvs;
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t corner : triangle) {
      vertices.push_back(split.corners[corner].vertex);
      uvs.push_back(split.corners[corner].uv);
    }
    level.faces.push_back(split.face_of_look[look_of(triangle)]);
  }
  level.vertices = renumber(vertices, faces.topology.vertex_count);
  level.topology.vertex_count = static_cast<Index>(level.vertices.size());
  level.topology.corner_vertices = std::move(vertices);
  for (std::uint32_t t = 1; t <= triangles.size(); ++t) {
    level.topology.face_offsets.push_back(3 * t);  // after the 0 that is there
  }
  if (faces.topology.corner_uvs.empty()) return level;
  std::vector<std::uint32_t> used;
  std::copy_if(uvs.begin(), uvs.end(), std::back_inserter(used),
               [](std::uint32_t uv) { return uv != kNoIndex; });
  const std::vector<std::uint32_t> rows = renumber(used, faces.uvs.rows());
  level.uvs.resize(static_cast<Index>(rows.size()), 2);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    level.uvs.row(static_cast<Index>(i)) = faces.uvs.row(rows[i]);
  }
  for (std::size_t c = 0, next = 0; c < uvs.size(); ++c) {
    if (uvs[c] != kNoIndex) uvs[c] = used[next++];
  }
  level.topology.corner_uvs = std::move(uvs);
  return level;
}

}  // namespace

Positions DetailLevel::of(const Positions& whole) const {
  return rows_of(whole, vertices);
}

Displacements DetailLevel::of(const Displacements& whole) const {
  Displacements some;
  std::vector<std::uint32_t> rows;
  auto next = whole.vertices.begin();
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    next = std::lower_bound(next, whole.vertices.end(), vertices[v]);
    if (next == whole.vertices.end()) break;
    if (*next != vertices[v]) continue;
    some.vertices.push_back(v);
    rows.push_back(static_cast<std::uint32_t>(next - whole.vertices.begin()));
  }
  some.moves = rows_of(whole.moves, rows);
  return some;
}

std::vector<DetailLevel> detail_levels(const FaceSet& faces, std::span<const std::uint32_t> looks,
                                       std::span<const double> shares) {
  require(static_cast<Index>(looks.size()) == faces.topology.face_count(),
          "detail levels: ", looks.size(), " looks, ", faces.topology.face_count(), " faces");
  const SplitMesh split = split_mesh(faces, looks);
  const Positions mean = mean_head(faces);
  Positions positions(static_cast<Index>(split.corners.size()), 3);
  for (std::size_t i = 0; i < split.corners.size(); ++i) {
    positions.row(static_cast<Index>(i)) = mean.row(split.corners[i].vertex);
  }
  std::vector<DetailLevel> levels(shares.size());
  parallel_for_each(shares.size(), [&](std::size_t l) {
    const double most = shares[l] * static_cast<double>(split.triangles.size());
    levels[l] = level_of(
        split,
        reduce_triangles(split.triangles, positions, static_cast<std::size_t>(std::round(most))),
        faces);
    levels[l].share = shares[l];
  });
  return levels;
}

}  // namespace crowdface
