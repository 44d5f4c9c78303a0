// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "crowdface/blend/recipe.h"
#include "crowdface/region/region_weights.h"
#include "crowdface/smooth/chebyshev_filter.h"
#include "crowdface/texture/crowd_textures.h"
#include "crowdface/texture/paint_picture.h"
#include "crowdface/texture/surface_statistics.h"

namespace crowdface {

/// Options of TextureBlender.
struct TextureBlendOptions {
  /// how far the statistics of the heads' maps are smoothed over the mesh
  StatisticsScale statistics_scale;
  /// for each vertex: the area of the skin around it, in any unit; zero for vertices that do not
  /// count in the regions' shares of the face's area. Not all areas may be zero.
  std::vector<double> vertex_areas;
  /// For each vertex, whether it gets only the target's colours, as eyes and teeth do; may be
  /// empty.
  std::vector<bool> uses_target_colours_only;
};

/// Blends a texture for each face from the textures of the heads (docs/textures.md). The map of
/// head h has the values D_h: optical densities of colours, slopes of normals, or plain values. C_h
/// is the coarse part of D_h. The blended value D is given by this formula:
///
///     D = Σ W_h C_h + g Σ v_h (D_h − C_h)
///
/// The sums are over all heads h. The symbols have these meanings:
///
/// - W_h, the weight of the coarse part, is the same at all points of a face. W_h is the mean of
///   two weights of head h: the head's weight in the target's colours, and the area-weighted mean
///   of the head's weights in all regions (see colour_weights). The weights in the target's colours
///   are the recipe's colour weights if given; otherwise, they are the heads' weights in the target
///   (1 for the target head, or the weights of a mixture).
/// - v_h, the weight of the detail, varies over the face. v_h is the mean of W_h and the weight of
///   head h in the region at the point.
/// - The gain g restores the contrast of detail that averaging removes:
///   g² = Σ_h v_h c_hh / Σ_h Σ_i v_h v_i c_hi, where c_hi is the covariance of the details of heads
///   h and i. If the details of all heads agree, g is 1. The largest value of g is 1/√Σ v_h², the
///   gain for uncorrelated details (after Heitz & Neyret 2018).
///
/// If a head has no texture, the weight of this head goes to the heads that have textures. Results
/// are bit-identical on any number of threads.
class TextureBlender {
 public:
  /// Returns the result of `make()`, computed now or read from a cache.
  using FindStatistics =
      std::function<SurfaceStatistics(const std::function<SurfaceStatistics()>& make)>;
  /// \param texels             the mesh rasterized into the layout of `textures`.
  /// \param filter             a smoothing filter of the mesh; its operator may be
  ///                           OperatorKind::kUmbrella or OperatorKind::kLazy.
  /// \param regions, textures  these objects and the textures' maps must outlive the blender.
  /// \param find_statistics    a function that returns the statistics of the heads' maps; it may
  ///                           look them up in a cache.
  TextureBlender(
      const Topology& topology, std::shared_ptr<const LayoutTexels> texels,
      const ChebyshevFilter& filter, const RegionWeights& regions, const CrowdTextures& textures,
      TextureBlendOptions options,
      const FindStatistics& find_statistics = [](const auto& make) { return make(); });

  /// Blends one texture image of a face. Thread-safe.
  /// \throws IoError if a head's texture map is in a mapped cache file that another process has
  ///         truncated.
  /// \param picture  index of an image (picture) of the layout.
  BlendedPicture blend(const Recipe& recipe, std::size_t picture) const;

  /// The low-frequency statistics of the heads' maps: the coarse parts and the covariances of the
  /// details.
  const SurfaceStatistics& statistics() const { return statistics_; }

  const TextureLayout& layout() const { return textures_.layout; }
  /// The mesh rasterized into the layout.
  const std::shared_ptr<const LayoutTexels>& texels() const { return texels_; }

  /// Number of bytes of memory that this object uses, without the texels, which blenders share.
  std::size_t memory_bytes() const;
  /// Additional memory in bytes that `blend` needs for the largest texture image.
  std::size_t blend_bytes() const;

 private:
  /// Computes, for one texture image of a face, the base value and the heads' factors at each
  /// vertex.
  VertexFactorsOfImage vertex_factors_of_image(std::size_t picture, const Recipe& recipe) const;

  const RegionWeights& regions_;
  const CrowdTextures& textures_;
  TextureBlendOptions options_;
  std::shared_ptr<const LayoutTexels> texels_;  ///< the mesh rasterized into the layout
  std::vector<MapCoding> codings_;  ///< for each picture: the coding of the blended picture
  SurfaceStatistics statistics_;    ///< low-frequency statistics of the heads' maps
  /// #regions: fraction of the face that each region covers
  std::vector<double> region_area_fractions_;
};

/// For each region, the fraction of the face's area that the region covers.
/// \param vertex_areas  see TextureBlendOptions::vertex_areas.
std::vector<double> region_area_fractions(const RegionWeights& regions,
                                          const std::vector<double>& vertex_areas);

/// Colour weights of the heads in one face. Each list has #heads weights, which sum to one. The
/// weights for skin are the weights W_h of TextureBlender. The weights for eyes and teeth are the
/// heads' weights in the target's colours, which TextureBlender defines.
struct FaceColourWeights {
  std::vector<double> weights_for_skin, weights_for_eyes_and_teeth;
};
/// Computes the colour weights of the heads in the face of a recipe.
/// \param heads  number of heads
/// \param region_area_fractions  for each region: the fraction of the face's area that it covers
FaceColourWeights face_colour_weights(const Recipe& recipe, std::size_t heads,
                                      const std::vector<double>& region_area_fractions);

/// Colour weights of the heads in each region. If the recipe has colour weights, all regions have
/// the recipe's colour weights. Otherwise, a region has its own colour weights or, without these,
/// the weights of its finest band. If the weights sum to less than one (Normalization::kPrinted),
/// the target gets the remaining weight.
/// \return #regions by #heads, rows summing to one.
std::vector<std::vector<double>> colour_weights(const Recipe& recipe, std::size_t heads);

}  // namespace crowdface
