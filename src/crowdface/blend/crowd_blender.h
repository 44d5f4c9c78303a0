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

/// Blends many faces at once, with approximate smoothing. For each head C_h, the smoothing S̃_L to
/// any level L was fitted in advance:
///
///     S̃_L C_h = C_h + Σ_p φ_hp(L) c_hp    (Eq. 5)
///
/// Head h has the vector fields c_hp on the mesh, numbered by p. The field c_hp is multiplied by
/// φ_hp, which is a function of the level. With this fit, Eq. 7 becomes the following formula:
///
///     A = B + Σ_k α_k Σ_h Σ_p [ Σ_L s_kLh φ_hp(L) ] c_hp
///
/// - A is the blended face.
/// - B is the target: Σ_h τ_h C_h with the weights τ_h from target_head_weights.
/// - α_k are the vertex weights of region k.
/// - s_kLh is the weight of head h at level L in region k, from weights_by_level. If region k has
///   only one band, L is the level of this band and s_kLh = τ_h − e_k ω̂_kh, where e_k is the
///   band's extrapolation factor and ω̂_kh is the band's weight of head h (see BandRecipe).
///
/// For M faces, each region of a patch takes two matrix products. The first product multiplies the
/// fields of all heads at the patch's skeleton (the vertices from which all vertices of the patch
/// are interpolated) by a matrix with M columns of coefficients. The second product multiplies the
/// skeleton's interpolation weights by the first product. All M faces share the cost of reading
/// the fields.
///
/// The bits of a face do not depend on the faces that are blended with it, the number of threads or
/// the instruction set. A face whose coefficients are all zero (the target blended with itself) is
/// bit-identical to the target. All const methods may run concurrently.
class CrowdBlender {
 public:
  /// \param heads           must outlive this object.
  /// \param levels          for each head: its fitted smoothing to all levels.
  /// \param patches         the compressed fields of all heads.
  /// \param regions         α, #V by #regions, where rows sum to one; must outlive this object.
  /// \throws BrokenPrecondition if the arguments do not fit together.
  CrowdBlender(const HeadSet& heads, std::vector<HeadSmoothing> levels, FieldPatches patches,
               const RegionWeights& regions);

  /// Blends the face of each recipe, #V by 3, in the unit of the heads.
  ///
  /// \param results  receives the positions for each recipe. The function reuses the memory of
  ///                 these matrices.
  /// \throws BrokenPrecondition if a recipe does not fit the heads or the regions.
  void blend(std::span<const Recipe* const> recipes, std::span<Positions> results) const;
  /// Blends the face of a single recipe.
  Positions blend(const Recipe& recipe) const;

  /// Changes a face that was blended from the recipe `before` into the face of the recipe `after`.
  /// The result is bit-identical to `blend(after)`. If both faces are built on the same target head
  /// or mixture (Recipe::target, Recipe::mixture), recomputes only the patches that a changed
  /// region covers; otherwise all patches.
  ///
  /// \param face  #V by 3, the result of `blend` for `before`.
  void update(const Recipe& before, const Recipe& after, Positions& face) const;

 private:
  class FaceBatch;     ///< faces that are blended together, with their coefficients
  class PatchBlender;  ///< blends the vertices of one patch for all faces of a batch

  /// Finds the regions of each patch: fills patch_regions_ and region_offsets_.
  void find_regions();
  /// Returns the regions whose weight is nonzero at one or more vertices of the patch.
  std::span<const std::uint32_t> regions_of_patch(std::size_t patch) const {
    return std::span(patch_regions_)
        .subspan(region_offsets_[patch], region_offsets_[patch + 1] - region_offsets_[patch]);
  }
  /// Returns the coefficient Σ_L s_kLh φ_hp(L) of each field c_hp of each head, in region k of a
  /// face (see the formula of the class).
  std::vector<float> coefficients(const Recipe& recipe, std::size_t region) const;
  /// Blends only those patches for which wanted(patch) is true.
  template <class Wanted>
  void blend_patches(const Wanted& wanted, std::span<const Recipe* const> recipes,
                     std::span<Positions> results) const;
  /// Returns the number of fields of all heads together.
  std::size_t field_count() const { return field_offsets_.back(); }

  const HeadSet& heads_;
  std::vector<HeadSmoothing> head_smoothings_;  ///< the fitted smoothing of each head, to any level
  FieldPatches patches_;          ///< the vector fields c_hp of all heads (see the class comment)
  const RegionWeights& regions_;  ///< α, #V by #regions
  /// #heads + 1: for each head, the index of its first field among the fields of all heads
  std::vector<std::size_t> field_offsets_;
  /// indices of each patch's regions (see regions_of_patch), one patch after the other
  std::vector<std::uint32_t> patch_regions_;
  /// #patches + 1: for each patch, the index of its first entry in patch_regions_.
  std::vector<std::size_t> region_offsets_;
};

}  // namespace crowdface
