// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/blend/normalization.h"
#include "crowdface/mesh/topology.h"
#include "crowdface/plane/weights.h"

namespace crowdface {

/// A head whose detail takes part, and its normalised weight ω̂.
struct SourceWeight {
  Index head = 0;
  double weight = 0;
  bool operator==(const SourceWeight&) const = default;
};

/// A band of detail: whose it is, how strong, and at which level it begins. It ends where the next
/// finer one begins, the last one at level 0.
struct BandRecipe {
  std::optional<PlanePoint> position;  ///< m_k, if the weights come from one
  std::vector<SourceWeight> weights;   ///< ω̂_ki, ascending heads, none zero
  double smoothness = 0;               ///< L_k/L_max
  std::uint64_t iterations = 0;        ///< L_k
  double extrapolation = 1;            ///< e_k, the factor of Fig. 6
};

/// What a recipe says about one region: its coarsest band, all that Eq. 7 needs, and those finer.
struct RegionRecipe : BandRecipe {
  std::vector<BandRecipe>
      finer;  ///< coarse to fine; none begins at a higher level than the one before
};

std::size_t band_count(const RegionRecipe& region);
/// Band number `band`, from 0, the coarsest.
BandRecipe& band_of(RegionRecipe& region, std::size_t band);
const BandRecipe& band_of(const RegionRecipe& region, std::size_t band);

/// What determines a face: with the face set and the regions it gives the mesh to the bit.
struct Recipe {
  Index target = 0;                   ///< B; of a mixture the head whose file and parts are taken
  std::vector<RegionRecipe> regions;  ///< one for each region
  /// B may be a mixture, B = Σ_h τ_h B_h: its τ_h, ascending heads, none zero, summing to one. Empty:
  /// the target alone. As Eq. 2 is linear in B, so is all that is computed from it.
  std::vector<SourceWeight> mixture = {};
  /// Whose textures the face wears, ascending heads, none zero, summing to one. Empty: by the weights of its shape.
  std::vector<SourceWeight> colours = {};
  /// What makes left and right differ in the blended skin counts so often; 1: as blended, 0: symmetric.
  double asymmetry = 1;
  bool mirrored = false;  ///< the face, parts and all, is the mirror image of what the rest says
};

/// Whether the face is blended, and no more.
bool is_unmirrored(const Recipe& recipe);
/// How much the mirror image counts in the whole face, see mirror_share.
double mirror_share(const Recipe& recipe);

/// The heads that a region smooths to one level, see level_shares.
struct LevelShares {
  std::uint64_t level = 0;
  std::vector<SourceWeight> shares;  ///< s_h in the order they are added; a head may stand twice
};

/// Whether extrapolation factors count, or are taken as 1.
enum class Extrapolation { kAsGiven, kNone };

/// What a region adds to B, by levels. With bands b = 1 … n that begin at L_1 ≥ … ≥ L_n and end at the
/// next, L_{n+1} = 0, and C̄_b = Σ_i ω̂_bi C_i,
///
///     S_{L_1} B + Σ_b e_b (S_{L_{b+1}} − S_{L_b}) C̄_b = B + Σ_b (S_{L_b} − 1) G_b,
///     G_1 = B − e_1 C̄_1,   G_b = e_{b−1} C̄_{b−1} − e_b C̄_b
///
/// so that bands of the same weights and factor are one band, and one band is Eq. 7.
/// \return  for each band its L_b and the heads in G_b.
std::vector<LevelShares> level_shares(const Recipe& recipe, std::size_t region,
                                      Extrapolation extrapolation = Extrapolation::kAsGiven);

/// The τ_h of B: those of a mixture, or 1 for the target.
std::vector<SourceWeight> target_shares(const Recipe& recipe);

/// Makes B of these heads. The target is the one with the largest share, of equals the first.
/// \param shares  ascending heads, above zero, summing to one.
void set_target(Recipe& recipe, std::vector<SourceWeight> shares);

/// B = Σ_h τ_h B_h, where of(h) is the matrix B_h: positions, or whatever is linear in them.
template <class Matrix, class Of>
Matrix target_matrix(const Recipe& recipe, const Of& of) {
  Matrix sum = of(recipe.target);
  if (recipe.mixture.empty()) return sum;
  sum.setZero();
  for (const SourceWeight& part : recipe.mixture) {
    sum += static_cast<typename Matrix::Scalar>(part.weight) * of(part.head);
  }
  return sum;
}

/// The weights ω̂ of a position (Eqs. 3 and 4).
/// Partition: the target takes part as face 0 with its own detail, whether or not it is a source,
/// and the weights sum to one. Printed: the target's ω_0 counts in the denominator only and is left
/// out of the result, whose weights sum to less than one.
/// \param anchors      #heads
/// \param sources      heads that lend detail, ascending
/// \param max_sources  keep only that many of the largest weights beside the target's (of equals
///                     the first), then normalise again; ω_0 always stays and is not counted
std::vector<SourceWeight> weights_at(const std::vector<PlanePoint>& anchors, Index target,
                                     const std::vector<Index>& sources, const PlanePoint& position,
                                     Normalization normalization, std::optional<int> max_sources);

/// Hand-written weights, divided by their sum; zero weights are left out.
/// \throws BrokenPrecondition if one is negative or not finite, or if they sum to zero.
std::vector<SourceWeight> normalized_weights(std::vector<SourceWeight> weights);

}  // namespace crowdface
