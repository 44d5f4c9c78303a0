// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/smooth/field_tile.h"
#include "crowdface/smooth/level_fields.h"

namespace crowdface {

/// Vertices that follow each other in the mesh, of one tile of the fields.
struct VertexRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// All heads' fields and what they are multiplied with in one face.
struct WeightedFields {
  std::vector<const LevelFields*> heads;
  std::vector<std::size_t>
      first_field;  ///< #heads + 1: of all heads' fields, which is a head's first
  std::vector<std::vector<float>> coefficients;  ///< #regions by #fields of all heads
};

/// Adds up the fields of one face straight from where they lie: nobody else would use what is unpacked.
/// For one thread.
class SingleFaceSums {
 public:
  /// \param fields  must outlive the sums.
  explicit SingleFaceSums(const WeightedFields& fields) : fields_(fields) {}

  /// The regions of the runs to come.
  void start(std::span<const std::uint32_t> regions);
  /// result[i] = Σ_k alpha[k][i]·Σ_f coefficients[k][f]·field_f[i] at the run's 3·count values (Eq. 7), k in the order
  /// of the regions.
  /// \param next   the run after it: memory is asked for its fields.
  /// \param alpha  of each of the regions
  void add_up(const VertexRun& run, const VertexRun& next, std::span<const float* const> alpha,
              float* result);

 private:
  static constexpr std::size_t kRegionsAtOnce = 2;  ///< that `add_fields` takes
  struct alignas(64) TileSums {
    std::array<float, kTileValues> values;
  };
  void find_tiles(std::uint32_t vertex, std::vector<TileFields>& tiles) const;
  void add_regions(std::span<const std::uint32_t> regions, std::size_t begin, std::size_t end);

  const WeightedFields& fields_;
  std::span<const std::uint32_t> regions_;
  std::vector<std::uint32_t> lenders_;          ///< heads that add anything in one of the regions
  std::vector<TileFields> tiles_, next_tiles_;  ///< of each lender
  std::uint32_t next_of_ = kNoIndex;            ///< the vertex that next_tiles_ are of
  std::array<TileSums, kRegionsAtOnce> sums_;
  std::array<std::vector<float>, kRegionsAtOnce> in_steps_;  ///< coefficients times steps
};

}  // namespace crowdface
