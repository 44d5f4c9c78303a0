// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/blend/normalization.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/plane/weights.h"

namespace crowdface {

/// A head and its weight in a blend. Two kinds of heads have weights. Heads on which the face is
/// built have the weights of a mixture (Recipe::mixture). Heads that lend detail (the sources) have
/// the normalised weights of Eq. 3, which the docs call ω̂.
struct SourceWeight {
  Index head = 0;  ///< index of the head in the HeadSet
  double weight = 0;
  bool operator==(const SourceWeight&) const = default;
};

/// A band of detail: the weights of the heads that lend the detail, its strength, and the smoothing
/// level at which the band begins. A band ends at the level where the next finer band begins; the
/// finest band ends at level 0.
struct BandRecipe {
  /// m_k: the position on the weight plane from which `weights` were computed; empty if there is
  /// none
  std::optional<PlanePoint> position;
  /// ω̂_ki: the weights of the heads that lend the detail, by ascending head; no weight is zero
  std::vector<SourceWeight> weights;
  /// The smoothness of the band, L_k/L_max. The band begins at level L_k, that is, after L_k
  /// smoothing iterations; L_max is the number of iterations of the smoothest level.
  double smoothness = 0;
  /// L_k: the level at which the band begins, as a number of smoothing iterations
  std::uint64_t iterations = 0;
  /// e_k: the band's extrapolation factor (Fig. 6 of the paper, see docs/paper.md), which is the
  /// strength of the detail that the heads lend
  double extrapolation = 1;
};

/// The recipe of one region. The base class is the region's coarsest band. The paper's blend (Eq.
/// 7, docs/method.md) has only this band.
struct RegionRecipe : BandRecipe {
  /// all further bands, from coarse to fine; the level of each band is at most the level of the
  /// next coarser band
  std::vector<BandRecipe> finer_bands;
  /// The weights of the heads in the textures of this region, by ascending head; no weight is zero.
  /// Empty: the weights are those of the region's finest band. If Recipe::colours is not empty, its
  /// weights take precedence.
  std::vector<SourceWeight> colours = {};
};

/// Returns the number of bands of a region, including the coarsest band.
std::size_t band_count(const RegionRecipe& region);
/// Returns band number `band` of a region; band 0 is the coarsest.
BandRecipe& band_of(RegionRecipe& region, std::size_t band);
const BandRecipe& band_of(const RegionRecipe& region, std::size_t band);

/// The parameters of one new face. Together with the heads and the regions, a recipe determines the
/// face's mesh to the bit.
struct Recipe {
  /// Index of the target head B of Eq. 2, on which the face is built. If B is a mixture of heads,
  /// `target` is the head of the mixture from which the face takes its parts and the layout of its
  /// file.
  Index target = 0;
  /// for each region of the mask: which heads lend detail, and how much
  std::vector<RegionRecipe> regions;
  /// If the face is built on a mixture of heads instead of one head: the weights of the heads in
  /// this mixture, by ascending head, not zero, summing to one. If empty, the face is built on the
  /// head `target` alone. The blend (Eq. 2) is linear in the head on which the face is built, so
  /// its result is also linear in the heads of the mixture.
  std::vector<SourceWeight> mixture = {};
  /// The weights of the heads in the textures of all regions: by ascending head, not zero, summing
  /// to one. If empty, RegionRecipe::colours determines the weights in each region.
  std::vector<SourceWeight> colours = {};
  /// Factor on the differences between the left and the right half of the blended skin: 1 keeps the
  /// differences, 0 makes the skin symmetric.
  double asymmetry = 1;
  bool mirrored = false;  ///< whether the whole face, including its parts, is mirrored
};

/// Returns whether the recipe leaves the blended face without mirroring: `mirrored` is false and
/// `asymmetry` is 1.
bool is_unmirrored(const Recipe& recipe);
/// Returns the weight with which the face's mirror image is mixed into the face, see
/// mirror_image_weight(double, bool).
double mirror_image_weight(const Recipe& recipe);

/// A smoothing level, and the weighted heads whose sum is smoothed to this level; see
/// weights_by_level.
struct LevelWeights {
  std::uint64_t level = 0;  ///< number of smoothing iterations; L_b in weights_by_level
  /// the weights of the heads in the sum (G_b in weights_by_level), in the order of summation; a
  /// head may occur twice
  std::vector<SourceWeight> weights;
};

/// Whether extrapolation factors have the values in the recipe (kAsGiven) or are all 1 (kNone).
enum class Extrapolation { kAsGiven, kNone };

/// Returns, for each band b = 1 … n of a region, the level L_b at which the band begins and the
/// weights of the heads in the weighted sum G_b. The blend smooths G_b to level L_b.
///
/// - B is the target.
/// - C̄_b = Σ_i ω̂_bi C_i is the weighted mean of the heads C_i that lend band b.
/// - e_b is the extrapolation factor of band b.
/// - S_L is the smoothing to level L.
/// - Each band ends at the level at which the next band begins. The last band ends at L_{n+1} = 0.
///
/// The region's surface is the smoothed target plus all bands:
///
///     S_{L_1} B + Σ_b e_b (S_{L_{b+1}} − S_{L_b}) C̄_b
///
/// The terms of this sum, collected by level, are
///
///     B + Σ_b (S_{L_b} − 1) G_b,   G_1 = B − e_1 C̄_1,   G_b = e_{b−1} C̄_{b−1} − e_b C̄_b  (b > 1)
///
/// Adjacent bands with equal weights and factors act as one band. A single band gives Eq. 7.
std::vector<LevelWeights> weights_by_level(const Recipe& recipe, std::size_t region,
                                           Extrapolation extrapolation = Extrapolation::kAsGiven);

/// Returns the weights τ_h of the heads on which the face is built: the weights of Recipe::mixture
/// or, without a mixture, weight 1 for the head Recipe::target.
std::vector<SourceWeight> target_head_weights(const Recipe& recipe);

/// Sets the heads on which a recipe's face is built (B in Eq. 2): sets `mixture`, or leaves it
/// empty for a single head, and sets `target` to the head with the largest weight. If several heads
/// have the largest weight, the first of these becomes the target.
///
/// \param weights  weights by ascending head, above zero, summing to one.
void set_target_heads(Recipe& recipe, std::vector<SourceWeight> weights);

/// Returns B = Σ_h τ_h B_h: the mean of the matrices of the heads in Recipe::mixture, with the
/// weights τ_h of the mixture; without a mixture, the matrix of Recipe::target.
///
/// \param head_matrix  head_matrix(h) returns the matrix B_h: positions, or values that are linear
/// in the positions.
template <class Matrix, class HeadMatrix>
Matrix target_matrix(const Recipe& recipe, const HeadMatrix& head_matrix) {
  Matrix sum = head_matrix(recipe.target);
  if (recipe.mixture.empty()) return sum;
  sum.setZero();
  for (const SourceWeight& part : recipe.mixture) {
    sum += static_cast<typename Matrix::Scalar>(part.weight) * head_matrix(part.head);
  }
  return sum;
}

/// Returns the weights ω̂ that a position on the weight plane gives to the heads (Eqs. 3 and 4). In
/// these equations, ω_0 is the weight of the target.
///
/// - Partition: the target lends its own detail like a source, whether or not it is in `sources`;
///   the returned weights sum to one.
/// - Printed (as in the paper): ω_0 occurs only in the denominator and is not returned, so the
///   returned weights sum to less than one.
///
/// \param anchors      one anchor per head.
/// \param sources      heads that lend detail, ascending.
/// \param max_sources  If given, only this number of the largest weights is kept before the
///                     normalisation; among equal weights, those of the first heads. ω_0 is always
///                     kept, in addition to this number.
std::vector<SourceWeight> weights_at_position(const std::vector<PlanePoint>& anchors, Index target,
                                              const std::vector<Index>& sources,
                                              const PlanePoint& position,
                                              Normalization normalization,
                                              std::optional<int> max_sources);

/// Divides weights by their sum, removes zero weights and sorts by head.
///
/// \throws BrokenPrecondition if a weight is negative or not finite, or if the sum is zero or not
/// finite.
std::vector<SourceWeight> normalized_weights(std::vector<SourceWeight> weights);

}  // namespace crowdface
