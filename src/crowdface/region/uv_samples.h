// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <set>
#include <string>
#include <vector>

#include "crowdface/core/compressed_rows.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A texture coordinate at which a mask is sampled for a vertex.
struct UvSample {
  int tile = 0;  ///< UDIM number
  double u = 0;  ///< `u` and `v`: texture coordinate as in the mesh file, not relative to the tile
  double v = 0;
  auto operator<=>(const UvSample&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The distinct texture coordinates of each vertex, collected from its corners. If a coordinate
/// lies on the border of tiles, the coordinate occurs once for each tile that holds a polygon of
/// the vertex.
using UvSamples = CompressedRows<UvSample>;

/// The column (for u) or row (for v) of the tile that contains a corner's coordinate: the integer
/// part of the coordinate. A coordinate that differs from an integer by at most 1e-4 lies on the
/// border of two tiles; the mean coordinate of the corner's polygon selects one of these tiles.
double tile_index(double coordinate, double polygon_mean);

/// How a mask covers the texture coordinates: by a single image (kOne; every sample has the tile
/// kFirstTile), or by UDIM tiles (kUdim).
enum class UvTiling { kOne, kUdim };

/// Collects the texture coordinates of every vertex. The list of a vertex that no polygon uses is
/// empty.
/// \param is_needed  one entry per vertex, or empty for all vertices: whether the vertex must have
///                   a texture coordinate.
/// \param mesh_name  name or file of the mesh, for messages.
/// \throws InvalidInput if a needed vertex that some polygon uses has no texture coordinate at any
///         corner, or if a coordinate lies outside all UDIM tiles (for UvTiling::kUdim). The
///         message names the mesh and the vertex.
UvSamples gather_uv_samples(const Topology& topology, const TextureCoordinates& uvs,
                            UvTiling tiling, const std::vector<bool>& is_needed = {},
                            const std::string& mesh_name = "the mesh");

/// The UDIM numbers of all tiles that contain at least one sample.
std::set<int> tiles_of(const UvSamples& samples);

}  // namespace crowdface
