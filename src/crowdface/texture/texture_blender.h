// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/texture/crowd_textures.h"
#include "crowdface/texture/paint_picture.h"
#include "crowdface/texture/surface_statistics.h"

namespace crowdface {

struct TextureBlending {
  StatisticsScale scale;
  /// #V: how much each vertex counts in a face's mean; not all zero.
  std::vector<double> areas;
  /// #V: whether the target alone lends its colours there (eyes, teeth); or empty.
  std::vector<bool> of_target;
};

/// Gives each face a texture of its own, from those of the heads (docs/textures.md). With the numbers D_h of
/// the heads' maps, densities of colours or slopes of normals, and their coarse part C_h,
///
///     D = Σ W_h C_h + g Σ v_h (D_h − C_h)
///
/// The weights W_h are one set for the whole face, half the target's and half the mean of the regions';
/// v_h is half of that and half what the region's weights are at the place. The gain g gives detail the
/// strength that a mean takes from it: g² = Σ v_h c_hh / ΣΣ v_h v_i c_hi of the details' covariances c, 1
/// where details agree, 1/√Σ v_h² where they do not (after Heitz & Neyret 2018). Where a head has no
/// texture the others have its weight. The same bits on any number of threads.
class TextureBlender {
 public:
  /// Gives what `make()` would: it may have been made before.
  using FindStatistics =
      std::function<SurfaceStatistics(const std::function<SurfaceStatistics()>& make)>;
  /// \param filter  of the mesh, whatever its kind. \param regions, textures  must outlive this object; so must the maps.
  TextureBlender(
      const Topology& topology, const TextureCoordinates& uvs, const ChebyshevFilter& filter,
      const RegionWeights& regions, const CrowdTextures& textures, TextureBlending options,
      const FindStatistics& find = [](const auto& make) { return make(); });

  /// \param picture  of the layout's. Any thread may ask.
  BlendedPicture blend(const Recipe& recipe, std::size_t picture) const;

  /// What this object itself takes, and what the blending of the largest picture takes.
  std::size_t memory_bytes() const;
  std::size_t blend_bytes() const;

 private:
  PictureFields fields(std::size_t picture, const Recipe& recipe) const;

  const RegionWeights& regions_;
  const CrowdTextures& textures_;
  TextureBlending options_;
  std::vector<SurfaceTexels> texels_;  ///< #pictures
  std::vector<MapCoding> codings_;     ///< #pictures: what all maps have in common
  SurfaceStatistics statistics_;
  std::vector<double> region_shares_;  ///< #regions, how much of the face each covers
};

/// How much of the face each region covers. \param areas  #V, of the face
std::vector<double> region_shares(const RegionWeights& regions, const std::vector<double>& areas);

/// What each head lends of its colours to a face as a whole (W above), and to eyes and teeth.
struct FaceColourWeights {
  std::vector<double> whole, of_target;  ///< #heads, each summing to one
};
FaceColourWeights face_colour_weights(const Recipe& recipe, std::size_t heads,
                                      const std::vector<double>& region_shares);

/// What each head lends of its colours in each region, as the recipe's weights are: those of its sources,
/// and where these do not sum to one (Normalization::kPrinted) the target has the rest; or in each the recipe's colours,
/// if it has some of its own.
/// \return #regions by #heads, rows summing to one.
std::vector<std::vector<double>> colour_weights(const Recipe& recipe, std::size_t heads);

}  // namespace crowdface
