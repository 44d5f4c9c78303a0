// SPDX-License-Identifier: Apache-2.0
#include "crowdface/region/uv_samples.h"

#include <algorithm>
#include <cmath>

#include "crowdface/core/error.h"
#include "crowdface/core/require.h"
#include "crowdface/core/text.h"
#include "crowdface/io/tile_files.h"

namespace crowdface {
namespace {

/// The mean of a face's texture coordinates, over the corners that have one.
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

UvSample sample_at(const Eigen::RowVector2d& uv, const Eigen::RowVector2d& mean, Tiles tiles) {
  if (tiles == Tiles::kOne) return {kFirstTile, uv[0], uv[1]};
  return {tile_number(tile_step(uv[0], mean[0]), tile_step(uv[1], mean[1])), uv[0], uv[1]};
}

/// For each corner its sample; the samples of a vertex lie together, in the order of its corners.
struct CornerSamples {
  std::vector<std::uint32_t> offsets;
  std::vector<UvSample> samples;
};

CornerSamples samples_by_vertex(const Topology& topology, const TextureCoordinates& uvs,
                                Tiles tiles) {
  CornerSamples out;
  out.offsets.assign(static_cast<std::size_t>(topology.vertex_count) + 1, 0);
  for (std::size_t c = 0; c < topology.corner_uvs.size(); ++c) {
    if (topology.corner_uvs[c] != kNoIndex) ++out.offsets[topology.corner_vertices[c] + 1];
  }
  for (std::size_t i = 1; i < out.offsets.size(); ++i) out.offsets[i] += out.offsets[i - 1];
  out.samples.resize(out.offsets.back());
  std::vector<std::uint32_t> next(out.offsets.begin(), out.offsets.end() - 1);
  for (Index f = 0; f < topology.face_count() && !topology.corner_uvs.empty(); ++f) {
    const auto begin = topology.face_offsets[static_cast<std::size_t>(f)];
    const auto end = topology.face_offsets[static_cast<std::size_t>(f) + 1];
    const std::span corners(topology.corner_uvs.data() + begin, end - begin);
    const Eigen::RowVector2d mean = mean_uv(corners, uvs);
    for (auto c = begin; c < end; ++c) {
      const std::uint32_t uv = topology.corner_uvs[c];
      if (uv == kNoIndex) continue;
      out.samples[next[topology.corner_vertices[c]]++] = sample_at(uvs.row(uv), mean, tiles);
    }
  }
  return out;
}

void check_every_used_vertex(const Topology& topology, const CornerSamples& samples) {
  for (Index f = 0; f < topology.face_count(); ++f) {
    for (const std::uint32_t vertex : topology.face(f)) {
      if (samples.offsets[vertex] < samples.offsets[vertex + 1]) continue;
      throw InvalidInput(concat("masks need texture coordinates: vertex ",
                                std::uint64_t{vertex} + 1, " of face ", f + 1,
                                " has no texture coordinate"));
    }
  }
}

}  // namespace

double tile_step(double coordinate, double polygon_mean) {
  const double whole = std::floor(coordinate);
  return whole == coordinate ? std::floor(polygon_mean) : whole;
}

UvSamples gather_uv_samples(const Topology& topology, const TextureCoordinates& uvs, Tiles tiles) {
  require(uvs.allFinite() &&
              std::all_of(topology.corner_uvs.begin(), topology.corner_uvs.end(),
                          [&](std::uint32_t uv) { return uv == kNoIndex || uv < uvs.rows(); }),
          "region: texture coordinates that are not finite or not there");
  CornerSamples corners = samples_by_vertex(topology, uvs, tiles);
  check_every_used_vertex(topology, corners);
  UvSamples out;
  out.offsets.push_back(0);
  for (Index i = 0; i < topology.vertex_count; ++i) {
    const auto first = corners.samples.begin() + corners.offsets[static_cast<std::size_t>(i)];
    const auto last = corners.samples.begin() + corners.offsets[static_cast<std::size_t>(i) + 1];
    // Sorted, so that the mean's last bits do not depend on the order of the faces.
    std::sort(first, last);
    out.samples.insert(out.samples.end(), first, std::unique(first, last));
    out.offsets.push_back(static_cast<std::uint32_t>(out.samples.size()));
  }
  return out;
}

std::set<int> tiles_of(const UvSamples& samples) {
  std::set<int> tiles;
  for (const UvSample& sample : samples.samples) {
    if (!tiles.contains(sample.tile)) tiles.insert(sample.tile);
  }
  return tiles;
}

}  // namespace crowdface
