// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "crowdface/bake/bake_template.h"
#include "crowdface/bake/scan_colours.h"
#include "crowdface/wrap/scan_surface.h"

namespace crowdface {

struct BakeOptions {
  /// Whether to remove shading: the part of the brightness that spherical harmonics of the normals
  /// explain.
  bool delight = false;
};

/// A baked texture of the template.
struct BakedPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> srgb;    ///< height by width by 3
  std::vector<std::uint8_t> filled;  ///< height by width: 255 where no colour comes from the scan
  double filled_share = 0;           ///< mean of `filled` over the covered texels, 0 to 1
};

/// Transfers the colours of a scan to the texture layout of a template that was wrapped onto it.
///
/// For each texel, the bake searches along the smooth normal of the wrapped skin for the nearest
/// surface of the scan that faces the same way. The texel takes the mean colour of the scan over
/// the texel's area. In holes of the scan, a texel keeps the template's colour, shifted by the
/// difference of optical densities between scan and template. The difference continues smoothly
/// into holes as a membrane, as in Poisson image editing (Pérez et al. 2003). The membrane lies on
/// the mesh, so that it crosses the seams of the texture.
class ScanBake {
 public:
  /// \param wrapped  #V by 3, as `wrap` returns them: in the template's frame, in millimetres.
  /// \param surface  the scan in the template's frame.
  /// All parameters must outlive this object.
  ScanBake(const BakeTemplate& target, const Positions& wrapped, const ScanSurface& surface,
           const ScanColours& colours, const BakeOptions& options);

  /// Bakes one picture (texture image). The bytes do not depend on the number of threads.
  BakedPicture picture(std::size_t number) const;

 private:
  /// The point of the scan that lies on the normal of a point of the wrapped skin.
  struct ScanPoint {
    ScanArea area;
    double confidence = 0;  ///< 0 to 1
  };
  /// A texel or vertex of the wrapped skin.
  struct SkinPoint {
    Eigen::Vector3d position, normal;
    double openness = 1;  ///< see SkinMesh::openness
  };
  /// Mean length of the edges at a vertex of the skin.
  double edge_length(Index vertex) const;
  ScanPoint find_scan_point(const SkinPoint& from, std::uint32_t guess) const;
  /// The mean optical density of an area of the scan; nothing if the area has no colour.
  std::optional<Eigen::Vector3d> density_at(const ScanArea& area) const;
  /// The optical densities of the template over a texel; zero if the template has no texture.
  Eigen::Vector3d template_density(std::size_t picture, const Eigen::Vector2d& uv,
                                   const Eigen::Vector2d& across,
                                   const Eigen::Vector2d& down) const;
  /// Measures the scan at the vertices: sets `densities`, and returns the confidence of each.
  std::vector<double> measure_vertices(Positions& densities) const;
  void find_trust(const std::vector<double>& confidence);
  void estimate_shading(const std::vector<double>& confidence, const Positions& densities);
  /// Computes tone_ from the differences at the vertices.
  /// \param differences  #skin by 3: density of the scan minus that of the template.
  void match_tone(const std::vector<double>& confidence, const Positions& differences);

  /// One texel of a picture.
  struct Texel {
    const SurfaceTexels::Triangle* triangle = nullptr;
    std::array<std::uint32_t, 3> rows = {};  ///< rows of the triangle's corners in the skin
    Eigen::Vector3d across, down;  ///< vectors to the texel to the right and to the texel below
  };
  /// The colour of a texel of the skin, as optical densities, and the share of this colour that
  /// does not come from the scan.
  struct Colour {
    Eigen::Vector3d density = Eigen::Vector3d::Zero();
    double filled = 1;
  };
  Colour colour_of(const Texel& texel, std::size_t picture, int x, int y,
                   std::uint32_t& guess) const;

  const BakeTemplate& target_;
  const ScanSurface& surface_;
  const ScanColours& colours_;
  Positions positions_, normals_;  ///< #skin by 3
  double spacing_mm_;              ///< mean distance between neighbouring vertices of the scan
  std::vector<double> trust_;      ///< #skin: 0 at the edge of the scan, 1 away from it
  Positions tone_;                 ///< #skin by 3: density of the scan minus that of the template
  Positions shading_;              ///< #skin by 3: densities to remove; or no rows
};

}  // namespace crowdface
