// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/bake/bake_template.h"
#include "crowdface/bake/scan_colours.h"
#include "crowdface/texture/optical_density.h"
#include "crowdface/wrap/scan_surface.h"

namespace crowdface {

/// Options of ScanBake.
struct BakeOptions {
  /// Whether to remove shading from the colours. Shading is the variation in brightness that a
  /// function of the surface normal (spherical harmonics) explains.
  bool removes_shading = false;
};

/// A baked texture image in the layout of the template.
struct BakedPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> srgb;  ///< sRGB values of the texels: height by width by 3
  /// height by width: fraction of the texel's colour that does not come from the scan, as 0 … 255
  std::vector<std::uint8_t> mask_without_scan;
  double share_without_scan = 0;  ///< mean of `mask_without_scan` over the covered texels, 0 to 1
};

/// Transfers the colours of a scan to the texture layout of the template that was wrapped onto this
/// scan.
///
/// For each texel, the bake searches along the smooth normal of the wrapped skin for the nearest
/// surface of the scan that faces the same way. The texel takes the mean colour of the scan over
/// the texel's area. In holes of the scan, a texel keeps the template's colour, shifted by the
/// difference of optical densities between scan and template. The difference continues smoothly
/// into holes as a membrane, as in Poisson image editing (Pérez et al. 2003). The membrane lies on
/// the mesh, so that it crosses the seams of the texture.
class ScanBake {
 public:
  /// \param wrapped  #V by 3: positions of the wrapped template from `wrap`, in the template's
  /// frame, in millimetres.
  /// \param surface  the scan in the template's frame.
  /// All parameters must outlive this object.
  ScanBake(const BakeTemplate& bake_template, const Positions& wrapped, const ScanSurface& surface,
           const ScanColours& colours, const BakeOptions& options);

  /// Bakes one picture (texture image). The bytes do not depend on the number of threads.
  BakedPicture bake_picture(std::size_t picture) const;

 private:
  /// The point in which the line along a skin point's normal meets the scan.
  struct ScanPoint {
    ScanArea area;  ///< the point of the scan, and the area around this point that one texel covers
    /// 0 to 1: how reliably this point of the scan shows the skin point. 0 if the point is too far
    /// away, faces another direction, or lies at a hole of the scan.
    double confidence = 0;
  };
  /// A point of the wrapped skin: a vertex or a sample point of a texel.
  struct SkinPoint {
    Eigen::Vector3d position, normal;
    double ambient_visibility = 1;  ///< 1 − ambient occlusion, see vertex_ambient_visibility
  };
  /// Mean length in mm of the edges at a vertex of the skin.
  double mean_edge_length(Index vertex) const;
  /// Finds the point of the scan that gives a skin point its colour.
  /// \param guess  a scan triangle that is probably near the result, or kNoIndex; for speed only.
  ScanPoint find_scan_point(const SkinPoint& skin_point, std::uint32_t guess) const;
  /// The mean optical density of each colour channel over an area of the scan; nothing if the area
  /// has no colour.
  std::optional<Eigen::Vector3d> mean_optical_density(const ScanArea& area) const;
  /// The mean optical density of each colour channel of the template's texture over a texel; zero
  /// if the template has no texture.
  Eigen::Vector3d template_optical_density(std::size_t picture, const Eigen::Vector2d& uv,
                                           const Eigen::Vector2d& to_right_texel,
                                           const Eigen::Vector2d& to_lower_texel) const;
  /// Measures the scan's optical density at each skin vertex.
  /// \param optical_densities  receives one row for each skin vertex.
  /// \return  one value for each row, 0 to 1: how well the scan shows the skin there (confidence).
  std::vector<double> measure_scan_optical_densities(OpticalDensities& optical_densities) const;
  /// Computes hole_fade_weights_, which fade the scan's colours out towards holes of the scan.
  /// \param confidence  return value of measure_scan_optical_densities.
  void compute_hole_fade_weights(const std::vector<double>& confidence);
  /// Computes shading_densities_ from the scan's optical densities at the skin vertices.
  /// \param confidence  return value of measure_scan_optical_densities.
  void estimate_shading(const std::vector<double>& confidence, const OpticalDensities& densities);
  /// Computes tone_differences_: keeps the differences where the scan has colours, and continues
  /// them smoothly into the holes of the scan.
  /// \param confidence   return value of measure_scan_optical_densities.
  /// \param differences  #skin by 3: optical density of the scan minus that of the template.
  void compute_tone_differences(const std::vector<double>& confidence,
                                const OpticalDensities& differences);

  /// One texel of a picture.
  struct Texel {
    const SurfaceTexels::Triangle* triangle = nullptr;  ///< the triangle that covers the texel
    /// skin vertices at the corners of the triangle, as row indices of `positions_`
    std::array<std::uint32_t, 3> rows = {};
    /// vector on the wrapped skin from this texel's centre to its right neighbour, in mm
    Eigen::Vector3d to_right_texel;
    /// vector on the wrapped skin from this texel's centre to its lower neighbour, in mm
    Eigen::Vector3d to_lower_texel;
  };
  /// The colour of a texel, as optical densities, and the fraction of the colour that comes from
  /// the template instead of the scan.
  struct Colour {
    /// optical density of the texel in each colour channel
    Eigen::Vector3d density = Eigen::Vector3d::Zero();
    double share_without_scan = 1;  ///< fraction of the colour that comes from the template, 0 to 1
  };
  /// Returns the baked colour of a texel.
  /// \param x, y   column and row of the texel in the picture
  /// \param guess  see find_scan_point; receives the triangle that was found
  Colour colour_of(const Texel& texel, std::size_t picture, int x, int y,
                   std::uint32_t& guess) const;

  const BakeTemplate& template_;
  const ScanSurface& surface_;  ///< the scan in the template's frame
  const ScanColours& colours_;
  /// #skin by 3: positions and normals of the vertices of the wrapped skin
  Positions positions_, normals_;
  double scan_spacing_mm_;  ///< mean distance between neighbouring vertices of the scan
  /// one per skin vertex: 0 at the holes of the scan, 1 far from all holes
  std::vector<double> hole_fade_weights_;
  /// #skin by 3: smooth difference of optical densities, scan minus template
  OpticalDensities tone_differences_;
  /// #skin by 3: density that the scan's baked-in shading adds; no rows if the shading is kept
  OpticalDensities shading_densities_;
};

}  // namespace crowdface
