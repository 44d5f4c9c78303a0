// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <set>
#include <vector>

#include "crowdface/core/grouped.h"
#include "crowdface/mesh/topology.h"

namespace crowdface {

/// A place in a texture: where a mask is looked up for a vertex.
struct UvSample {
  int tile = 0;  ///< UDIM number
  double u = 0;  ///< as in the file, not relative to the tile
  double v = 0;
  auto operator<=>(const UvSample&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// The distinct places of every vertex: those of its corners, each value once (a value on the
/// border of two tiles once for each of the tiles its faces lie in).
using UvSamples = Grouped<UvSample>;

/// The column (for u) or row (for v) of the tile that a coordinate of a corner lies in: its whole
/// part, and where the coordinate is a whole number and so lies on a border, that of the mean of
/// its polygon's coordinates.
double tile_step(double coordinate, double polygon_mean);

/// One picture for all coordinates (every sample's tile is kFirstTile), or UDIM tiles.
enum class Tiles { kOne, kUdim };

/// The places of every vertex; a vertex in no face has none.
/// \param needed  #V, the vertices that must have one; empty: all.
/// \throws InvalidInput if a needed vertex of a face has no texture coordinate at any of its corners, or one
///         outside all UDIM tiles (where there are tiles).
UvSamples gather_uv_samples(const Topology& topology, const TextureCoordinates& uvs, Tiles tiles,
                            const std::vector<bool>& needed = {});

/// The tiles that some sample lies in.
std::set<int> tiles_of(const UvSamples& samples);

}  // namespace crowdface
