// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/smooth/field_patches.h"

namespace crowdface {

/// Builds faces from fitted levels (Eqs. 5–7 with S̃), many at once:
///
///     A = B + Σ_k α_k Σ_h Σ_p [ Σ_L s_kLh φ_hp(L) ] c_hp
///
/// with the shares s_kLh of level_shares (of one band: s_kh = τ_h − e_k ω̂_kh at L_k), since
/// C − S̃_L C = −Σ_p φ_p c_p(C). For M faces that is, for each patch of vertices and each region there, a product of
/// all heads' fields at the patch's skeleton with a matrix of M columns of coefficients, and one of the skeleton's weights
/// with what comes of it: what fields cost to read is
/// shared by the faces. A face has the same bits alone and in any company, on any number of threads
/// and with any instruction set; one that adds nothing (the target with itself) keeps the target's.
class CrowdBlender {
 public:
  /// \param levels   one for each head of the face set.
  /// \param patches  of their fields
  /// \param regions  α, #V by #regions, rows summing to one.
  /// \throws BrokenPrecondition if these do not fit together.
  CrowdBlender(const FaceSet& faces, std::vector<HeadLevels> levels, FieldPatches patches,
               const RegionWeights& regions);

  /// The faces of the recipes, #V by 3 each, in the heads' unit.
  /// \param results  one for each recipe; what memory they hold is used again.
  /// \throws BrokenPrecondition if a recipe does not fit the face set or the regions.
  void blend(std::span<const Recipe* const> recipes, std::span<Positions> results) const;
  Positions blend(const Recipe& recipe) const;

  /// Makes of the face of one recipe that of another, with the same bits as `blend`: only vertices of
  /// patches where regions differ are computed.
  /// \param face  #V by 3, what `blend` made of `before`
  void change(const Recipe& before, const Recipe& after, Positions& face) const;

 private:
  class Crowd;
  class PatchBlender;

  void find_regions();
  /// Those with a weight at any of the patch's vertices.
  std::span<const std::uint32_t> regions_at(std::size_t patch) const {
    return std::span(patch_regions_)
        .subspan(first_region_[patch], first_region_[patch + 1] - first_region_[patch]);
  }
  std::vector<float> coefficients(const Recipe& recipe, std::size_t region) const;
  /// Blends at those of the patches that are wanted.
  template <class Wanted>
  void blend_at(const Wanted& wanted, std::span<const Recipe* const> recipes,
                std::span<Positions> results) const;
  std::size_t field_count() const { return first_field_.back(); }

  const FaceSet& faces_;
  std::vector<HeadLevels> levels_;
  FieldPatches patches_;
  const RegionWeights& regions_;
  std::vector<std::size_t>
      first_field_;  ///< #heads + 1: of all heads' fields, which is a head's first
  std::vector<std::uint32_t> patch_regions_;  ///< of all patches, one after the other
  std::vector<std::size_t> first_region_;     ///< #patches + 1: which of them is a patch's first
};

}  // namespace crowdface
