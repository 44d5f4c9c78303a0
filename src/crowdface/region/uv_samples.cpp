// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/uv_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "crowdface/core/error.h"
#include "crowdface/core/parallel.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

/// The mean texture coordinate of a polygon. Corners without a texture coordinate do not count.
Eigen::RowVector2d mean_uv(std::span<const std::uint32_t> corners, const TextureCoordinates& uvs) {
  Eigen::RowVector2d sum(0, 0);
  double count = 0;
  for (const std::uint32_t uv : corners) {
    if (uv == kNoIndex) continue;
    sum += uvs.row(uv);
    count += 1;
  }
  return count > 0 ? Eigen::RowVector2d(sum / count) : sum;
}

/// The number of the UDIM tile in which a polygon's corner lies.
/// \param uv    texture coordinates of the corner
/// \param mean  mean of the texture coordinates of the polygon's corners; decides if `uv` lies on
///              the border between two tiles
/// \throws InvalidInput, naming the mesh and the vertex, if the tile has no valid number.
int tile_of(const Eigen::RowVector2d& uv, const Eigen::RowVector2d& mean, std::uint32_t vertex,
            const std::string& mesh_name) {
  try {
    return tile_number(tile_index(uv[0], mean[0]), tile_index(uv[1], mean[1]));
  } catch (const InvalidInput& error) {
    throw InvalidInput(concat(mesh_name, ": vertex ", std::uint64_t{vertex} + 1,
                              ", texture coordinate ", uv[0], ", ", uv[1], ": ", error.what()));
  }
}

/// Returns the samples of each vertex: one sample for each corner of a polygon at this vertex that
/// has a texture coordinate, in the order of the corners.
UvSamples samples_by_vertex(const Topology& topology, const TextureCoordinates& uvs,
                            UvTiling tiling, const std::string& mesh_name) {
  const auto for_each_sample = [&](const auto& put) {
    for (Index f = 0; f < topology.face_count(); ++f) {
      const auto face_uvs = topology.face_uvs(f);
      const Eigen::RowVector2d mean = mean_uv(face_uvs, uvs);
      for (std::size_t c = 0; c < face_uvs.size(); ++c) {
        if (face_uvs[c] == kNoIndex) continue;
        const Eigen::RowVector2d uv = uvs.row(face_uvs[c]);
        const std::uint32_t vertex = topology.face(f)[c];
        const int tile =
            tiling == UvTiling::kOne ? kFirstTile : tile_of(uv, mean, vertex, mesh_name);
        put(vertex, {tile, uv[0], uv[1]});
      }
    }
  };
  return compressed_rows<UvSample>(static_cast<std::size_t>(topology.vertex_count),
                                   for_each_sample);
}

void check_every_used_vertex(const Topology& topology, const UvSamples& samples,
                             const std::vector<bool>& is_needed, const std::string& mesh_name) {
  for (Index f = 0; f < topology.face_count(); ++f) {
    for (const std::uint32_t vertex : topology.face(f)) {
      if (!samples.items_of(vertex).empty() || (!is_needed.empty() && !is_needed[vertex])) continue;
      throw InvalidInput(
          concat(mesh_name, ": masks need texture coordinates: vertex ", std::uint64_t{vertex} + 1,
                 " of face ", f + 1,
                 " has no texture coordinate (vertex weights, as text or .npy, do not need them)"));
    }
  }
}

}  // namespace

double tile_index(double coordinate, double polygon_mean) {
  constexpr double kMaxRoundingError = 1e-4;
  // No tile lies below 0, so a mean just below 0 is a rounding error, too.
  if (polygon_mean < 0 && polygon_mean >= -kMaxRoundingError) polygon_mean = 0;
  const double border = std::round(coordinate), tile = std::floor(polygon_mean);
  const bool is_beside_tile = border == tile || border == tile + 1;
  if (coordinate == border) return tile;
  if (std::abs(coordinate - border) <= kMaxRoundingError && is_beside_tile) return tile;
  return std::floor(coordinate);
}

UvSamples gather_uv_samples(const Topology& topology, const TextureCoordinates& uvs,
                            UvTiling tiling, const std::vector<bool>& is_needed,
                            const std::string& mesh_name) {
  require(uvs.allFinite() && std::ranges::all_of(topology.corner_uvs,
                                                 [&](std::uint32_t uv) {
                                                   return uv == kNoIndex || uv < uvs.rows();
                                                 }),
          "region: texture coordinates that are not finite or not there");
  UvSamples corners = samples_by_vertex(topology, uvs, tiling, mesh_name);
  check_every_used_vertex(topology, corners, is_needed, mesh_name);
  constexpr Index kBlock = 16384;
  std::vector<std::size_t> kept(static_cast<std::size_t>(topology.vertex_count));
  parallel_for_each(topology.vertex_count, kBlock, [&](Index i) {
    const std::span<UvSample> places = corners.items_of(i);
    // Sort the samples, so that the last bits of their mean do not depend on the order of the
    // polygons.
    std::sort(places.begin(), places.end());
    kept[static_cast<std::size_t>(i)] =
        static_cast<std::size_t>(std::unique(places.begin(), places.end()) - places.begin());
  });
  UvSamples out;
  out.reserve(kept.size(), std::accumulate(kept.begin(), kept.end(), std::size_t{0}));
  for (std::size_t i = 0; i < kept.size(); ++i) out.add_group(corners.items_of(i).first(kept[i]));
  return out;
}

std::set<int> tiles_of(const UvSamples& samples) {
  std::set<int> tiles;
  for (const UvSample& sample : samples.items) {
    if (!tiles.contains(sample.tile)) tiles.insert(sample.tile);
  }
  return tiles;
}

}  // namespace crowdface
