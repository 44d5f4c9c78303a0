// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "crowdface/mesh/topology.h"
#include "crowdface/smooth/field_tile.h"

namespace crowdface {

/// A tile's fields of one head.
struct TileFields {
  std::size_t count = 0;
  const float* steps = nullptr;
  const std::int16_t* numbers = nullptr;  ///< #count by kTileValues
};

/// Fields c_0 … c_{R−1} of one head, #V by 3 each. A tile of vertices has the first of them, as many as it needs;
/// the others are zero there. Values are whole numbers of 16 bits times a step of their tile and field: a power of two, so
/// that a product with it is exact, or zero. A value is off by half its step at most.
struct LevelFields {
  Index vertex_count = 0;
  Index rank = 0;  ///< R
  /// #tiles + 1: of all tiles' fields, one tile after the other, which is a tile's first.
  std::span<const std::uint32_t> first;
  std::span<const float> steps;           ///< of all tiles' fields, in the positions' unit
  std::span<const std::int16_t> numbers;  ///< of each kFieldTile by 3; past the last vertex zero
  std::shared_ptr<const void> owner;      ///< of all three

  static std::size_t tile_count(std::size_t vertices) {
    return (vertices + kFieldTile - 1) / kFieldTile;
  }
  /// Of the tile that a vertex stands in.
  TileFields at(std::size_t vertex) const {
    const std::size_t tile = vertex / kFieldTile, begin = first[tile];
    return {first[tile + 1] - begin, steps.data() + begin, numbers.data() + begin * kTileValues};
  }
  double value(Index field, Index vertex, Index coordinate) const;
};

/// Fields of tiles that follow each other.
struct FieldTiles {
  std::vector<std::uint32_t> counts;  ///< of each tile
  std::vector<float> steps;
  std::vector<std::int16_t> numbers;

  /// \param values  `count` by kTileValues, finite
  void add(std::span<const float> values, std::size_t count);
};

/// The least power of two that values can be told in with 16 bits; zero if there is none worth telling.
float step_of(std::span<const float> values);

/// Values as whole numbers, as many. \return their step.
float in_16_bits(std::span<const float> values, std::int16_t* numbers);

/// \param tiles  together all of the mesh, in order
LevelFields joined(Index vertex_count, Index rank, std::vector<FieldTiles> tiles);

/// \param fields  #R by #V by 3, finite; every tile has them all.
LevelFields in_16_bits(std::span<const float> fields, Index vertex_count);

}  // namespace crowdface
