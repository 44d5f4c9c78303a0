// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/blend/normalization.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/plane/weights.h"

namespace crowdface {

/// A head and its weight in a blend. The weights of the heads that lend detail are the normalised
/// ω̂.
struct SourceWeight {
  Index head = 0;
  double weight = 0;
  bool operator==(const SourceWeight&) const = default;
};

/// A band of detail: the heads that lend it, its strength, and the level at which it begins. A band
/// ends where the next finer band begins; the finest band ends at level 0.
struct BandRecipe {
  /// m_k: the position on the plane from which the weights were computed, if there is one
  std::optional<PlanePoint> position;
  std::vector<SourceWeight> weights;  ///< ω̂_ki, by ascending head, none zero
  double smoothness = 0;              ///< L_k/L_max
  std::uint64_t iterations = 0;       ///< L_k
  double extrapolation = 1;           ///< e_k, the factor of Fig. 6
};

/// The recipe of one region: its coarsest band (Eq. 7 has only this band) and its finer bands.
struct RegionRecipe : BandRecipe {
  std::vector<BandRecipe> finer_bands;  ///< coarse to fine, at non-increasing levels
  /// The weights of the heads in the region's textures, by ascending head, none zero. If empty, the
  /// weights of the finest band apply. Unused if the recipe has colours.
  std::vector<SourceWeight> colours = {};
};

/// Number of bands of a region, including the coarsest band.
std::size_t band_count(const RegionRecipe& region);
/// A band by number; band 0 is the coarsest.
BandRecipe& band_of(RegionRecipe& region, std::size_t band);
const BandRecipe& band_of(const RegionRecipe& region, std::size_t band);

/// The parameters of one face. Together with the heads and the regions, a recipe determines the
/// mesh to the bit.
struct Recipe {
  Index target = 0;  ///< the head B, or the head of a mixture whose file and parts the face uses
  std::vector<RegionRecipe> regions;  ///< one for each mask region
  /// The weights τ_h of a mixture B = Σ_h τ_h B_h: by ascending head, none zero, summing to one. If
  /// empty, B is the target alone. Eq. 2 is linear in B, so its results are also linear in the
  /// heads of the mixture.
  std::vector<SourceWeight> mixture = {};
  /// The weights of the heads in the blended textures: by ascending head, none zero, summing to
  /// one. If empty, the textures use the weights of the shape.
  std::vector<SourceWeight> colours = {};
  /// Factor on the left-right differences of the blended skin: 1 keeps them, 0 makes the skin
  /// symmetric.
  double asymmetry = 1;
  bool mirrored = false;  ///< mirrors the whole face including its parts
};

/// Returns whether the blended face stays unchanged: not mirrored, and with asymmetry 1.
bool is_unmirrored(const Recipe& recipe);
/// Returns the weight of the mirror image in the face, see mirrored_weight(double, bool).
double mirrored_weight(const Recipe& recipe);

/// A smoothing level of a region, and the weights of the heads that are smoothed to this level; see
/// level_shares.
struct LevelShares {
  std::uint64_t level = 0;
  std::vector<SourceWeight> shares;  ///< s_h in the order of summation; a head may occur twice
};

/// Whether to use the extrapolation factors of the recipe, or the factor 1.
enum class Extrapolation { kAsGiven, kNone };

/// Returns the levels of a region, and the weights of the heads that are smoothed to each level.
/// Let the bands b = 1 … n begin at levels L_1 ≥ … ≥ L_n; each band ends where the next begins,
/// with L_{n+1} = 0. With C̄_b = Σ_i ω̂_bi C_i, the region's surface is
///
///     S_{L_1} B + Σ_b e_b (S_{L_{b+1}} − S_{L_b}) C̄_b = B + Σ_b (S_{L_b} − 1) G_b,
///     G_1 = B − e_1 C̄_1,   G_b = e_{b−1} C̄_{b−1} − e_b C̄_b
///
/// Adjacent bands with equal weights and factors act as one band. A single band gives Eq. 7.
/// \return  for each band: L_b and the weights of the heads in G_b.
std::vector<LevelShares> level_shares(const Recipe& recipe, std::size_t region,
                                      Extrapolation extrapolation = Extrapolation::kAsGiven);

/// Returns the weights τ_h of B: the weights of the mixture, or weight 1 for the target alone.
std::vector<SourceWeight> target_shares(const Recipe& recipe);

/// Sets B to a mixture of heads, or to a single head. The target becomes the head with the largest
/// weight; if several have the largest weight, the first of them.
/// \param shares  by ascending head, above zero, summing to one.
void set_target(Recipe& recipe, std::vector<SourceWeight> shares);

/// Returns B = Σ_h τ_h B_h.
/// \param head_matrix  head_matrix(h) returns the matrix B_h: positions, or values that are linear
///                     in the positions.
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

/// Returns the weights ω̂ of a position on the plane (Eqs. 3 and 4).
///
/// - Partition: the target is face 0 and lends its own detail, whether or not it is in `sources`;
/// the weights sum to one.
/// - Printed (as in the paper): the target's ω_0 occurs only in the denominator and is not
///   returned, so the returned weights sum to less than one.
///
/// \param anchors      #heads
/// \param sources      heads that lend detail, ascending.
/// \param max_sources  the number of largest weights that are kept and normalised again; of equal
///                     weights, the first are kept. ω_0 is always kept and does not count towards
///                     this number.
std::vector<SourceWeight> weights_at_position(const std::vector<PlanePoint>& anchors, Index target,
                                              const std::vector<Index>& sources,
                                              const PlanePoint& position,
                                              Normalization normalization,
                                              std::optional<int> max_sources);

/// Divides weights by their sum, drops zero weights and sorts by head.
/// \throws BrokenPrecondition if a weight is negative or not finite, or if the sum is zero or not
///         finite.
std::vector<SourceWeight> normalized_weights(std::vector<SourceWeight> weights);

}  // namespace crowdface
