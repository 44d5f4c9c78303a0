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

/// The vector fields (see LevelFields) of one head at the vertices of one tile.
struct TileFields {
  std::size_t count = 0;                      ///< number of fields that the tile stores
  const float* quantization_steps = nullptr;  ///< quantization step of each field of the tile
  /// values of the fields, #count by kTileValues, as multiples of the quantization steps
  const std::int16_t* quantized_values = nullptr;
};

/// The vector fields c_0 … c_{R−1} of one head, each #V by 3, quantized to 16 bits. Each tile of
/// vertices stores only its leading fields, as many as the tile needs; the other fields of the tile
/// are zero. A value is a 16-bit integer times the quantization step of its tile and field. A step
/// is zero or a power of two, so that multiplying by it is exact. The rounding error is at most
/// half a step.
struct LevelFields {
  Index vertex_count = 0;
  Index rank = 0;  ///< R, the number of fields
  /// Index of each tile's first field in the concatenated fields of all tiles. The last entry is
  /// the total number of fields.
  std::span<const std::uint32_t> first_field_of_tile;
  /// for each stored field of a tile, its quantization step in the unit of the positions
  std::span<const float> quantization_steps;
  /// For each stored field of a tile, kTileVertices by 3 integers. Entries beyond the mesh's last
  /// vertex are zero.
  std::span<const std::int16_t> quantized_values;
  std::shared_ptr<const void> memory_owner;  ///< owns the memory of the three lists

  /// Number of tiles of a mesh with this many vertices.
  static std::size_t tile_count(std::size_t vertices) {
    return (vertices + kTileVertices - 1) / kTileVertices;
  }
  /// Returns the fields of the tile that contains the vertex.
  TileFields tile_fields(std::size_t vertex) const {
    const std::size_t tile = vertex / kTileVertices, begin = first_field_of_tile[tile];
    return {first_field_of_tile[tile + 1] - begin, quantization_steps.data() + begin,
            quantized_values.data() + begin * kTileValues};
  }
  /// Returns a coordinate (0 to 2) of a field at a vertex, in the unit of the positions.
  double value(Index field, Index vertex, Index coordinate) const;
};

/// The quantized fields of a sequence of tiles, stored one tile after another.
struct QuantizedTiles {
  std::vector<std::uint32_t> field_counts;  ///< number of fields of each tile
  std::vector<float> quantization_steps;    ///< quantization step of each stored field of each tile
  /// quantized values of the fields: kTileValues integers for each stored field
  std::vector<std::int16_t> quantized_values;

  /// Quantizes and appends the fields of one tile.
  /// \param values  `count` fields by kTileValues, finite; further values are ignored.
  void add(std::span<const float> values, std::size_t count);
};

/// Returns the smallest power of two such that all values, divided by this power and rounded, fit
/// into 16 bits.
/// Zero if all values are below 10⁻³⁰ in magnitude.
float quantization_step(std::span<const float> values);

/// Quantizes values to 16 bits.
/// \param quantized  receives values.size() numbers.
/// \return         the result of quantization_step.
float quantize(std::span<const float> values, std::int16_t* quantized);

/// Concatenates the fields of all tiles of a mesh.
/// \param tiles  all tiles, in order.
LevelFields concatenate(Index vertex_count, Index rank, std::vector<QuantizedTiles> tiles);

/// Quantizes R fields of a whole mesh. Each tile stores all R fields, unlike in QuantizedTiles.
/// \param fields  #R by #V by 3, finite.
LevelFields quantize(std::span<const float> fields, Index vertex_count);

}  // namespace crowdface
