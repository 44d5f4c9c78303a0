// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "crowdface/blend/crowd_product_kernels.h"
#include "crowdface/blend/recipe.h"
#include "crowdface/blend/single_face_sums.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/smooth/level_fields.h"

namespace crowdface {

/// The levels of a head as fields: S̃_L x = x + Σ_p φ_p(L)·c_p, fitted once (LevelBasis, or the
/// paper's CubicFit).
struct HeadLevels {
  LevelFields fields;                                                 ///< c_p
  std::function<std::vector<double>(std::uint64_t level)> functions;  ///< φ_0(L), φ_1(L), …
};

/// Builds faces from fitted levels (Eqs. 5–7 with S̃), many at once:
///
///     A = B + Σ_k α_k Σ_h Σ_p [ Σ_L s_kLh φ_hp(L) ] c_hp
///
/// with the shares s_kLh of level_shares (of one band: s_kh = τ_h − e_k ω̂_kh at L_k), since
/// C − S̃_L C = −Σ_p φ_p c_p(C). For M faces that is, for the vertices of a region, a product of
/// all heads' fields with a matrix of M columns of coefficients: what the fields cost to read is
/// shared by the faces. A face has the same bits alone and in any company, on any number of threads
/// and with any instruction set; one that adds nothing (the target with itself) keeps the target's.
class CrowdBlender {
 public:
  /// \param levels   one for each head of the face set.
  /// \param regions  α, #V by #regions, rows summing to one.
  /// \throws BrokenPrecondition if these do not fit together.
  CrowdBlender(const FaceSet& faces, std::vector<HeadLevels> levels, const RegionWeights& regions);

  /// The faces of the recipes, #V by 3 each, in the heads' unit.
  /// \param results  one for each recipe; what memory they hold is used again.
  /// \throws BrokenPrecondition if a recipe does not fit the face set or the regions.
  void blend(std::span<const Recipe* const> recipes, std::span<Positions> results) const;
  Positions blend(const Recipe& recipe) const;

  /// Makes of the face of one recipe that of another, with the same bits as `blend`: only vertices of
  /// regions that differ are computed.
  /// \param face  #V by 3, what `blend` made of `before`
  void change(const Recipe& before, const Recipe& after, Positions& face) const;

 private:
  /// Vertices whose values of all fields stay in a core's own cache while the faces pass over them.
  static constexpr std::size_t kBlockVertices = 128;
  static constexpr std::size_t kBlockValues = 3 * kBlockVertices;
  static constexpr std::size_t kBlockChunks = kBlockValues / kChunkValues;
  static_assert(kBlockValues % kChunkValues == 0);

  /// Up to kBlockVertices vertices that the same regions act on.
  struct Block {
    std::vector<VertexRun> runs;         ///< ascending
    std::size_t count = 0;               ///< of all runs
    std::vector<std::uint32_t> regions;  ///< those with a weight there
  };
  /// The coefficients of up to kChunkFaces faces in one region.
  struct Factors {
    std::vector<std::uint32_t> fields;  ///< those that any of the faces uses, ascending
    std::vector<float> coefficients;    ///< of all heads' fields, by kChunkFaces
  };
  /// Some values of one field, where vector loads can take them aligned.
  struct alignas(64) Chunk {
    float values[kChunkValues];
  };
  using BlockValues = std::array<float, kBlockValues>;

  class FieldsAhead;

  void cut_into_blocks();
  std::vector<float> coefficients(const Recipe& recipe, std::size_t region) const;
  Factors factors(std::span<const Recipe* const> recipes, std::size_t region) const;
  void prepare(const Recipe& recipe, Positions& result) const;
  /// Blends at those of the blocks that are wanted.
  template <class Wanted>
  void blend_one(const Recipe& recipe, const Wanted& wanted, Positions& result) const;
  std::size_t packed_rows() const { return field_count() + 1; }
  std::size_t field_count() const { return first_field_.back(); }
  std::vector<std::uint8_t> fields_at(const Block& block) const;
  void pack(const Block& block, const std::vector<std::uint8_t>& wanted,
            std::vector<Chunk>& packed) const;
  void spread_alpha(const Block& block, std::vector<BlockValues>& alpha) const;
  void displacements(const Block& block, const std::vector<Chunk>& packed,
                     const std::vector<BlockValues>& alpha, const std::vector<std::uint8_t>& wanted,
                     std::span<const Factors> of_region, FieldsAhead& ahead,
                     std::array<BlockValues, kChunkFaces>& result) const;
  void write(const Block& block, const Recipe& recipe, const BlockValues& added,
             Positions& result) const;

  const FaceSet& faces_;
  std::vector<HeadLevels> levels_;
  const RegionWeights& regions_;
  std::vector<std::size_t>
      first_field_;  ///< #heads + 1: of all heads' fields, which is a head's first
  std::vector<Block> blocks_;
};

}  // namespace crowdface
