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
  /// Removes shading: the part of the brightness that spherical harmonics of the normals explain.
  bool delight = false;
};

struct BakedPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> srgb;    ///< height by width by 3
  std::vector<std::uint8_t> filled;  ///< height by width: 255 where no colour comes from the scan
  double filled_share = 0;           ///< mean of `filled` over the covered texels, 0 to 1
};

/// Transfers the colours of a scan to the texture layout of a template that was wrapped onto it.
///
/// Each texel looks along the smooth normal of the wrapped skin for the nearest surface of the scan
/// that faces the same way, and takes the mean colour over its own area. Where the scan has no
/// data, or its surface ends, a texel keeps the template's colour, shifted by the difference of
/// optical densities between scan and template. This difference is continued smoothly into the
/// holes (a membrane, as Poisson image editing does: Pérez et al. 2003), but over the mesh, so that
/// it crosses the seams of the texture.
class ScanBake {
 public:
  /// \param wrapped  #V by 3, as `wrap` returns them: in the template's frame, in millimetres.
  /// \param surface  the scan in the template's frame.
  /// All parameters must outlive this object.
  ScanBake(const BakeTemplate& target, const Positions& wrapped, const ScanSurface& surface,
           const ScanColours& colours, const BakeOptions& options);

  /// Bakes one picture. The bytes do not depend on the number of threads.
  BakedPicture picture(std::size_t number) const;

 private:
  /// The point of the scan that a point of the wrapped skin sees along its normal.
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
  ScanPoint look(const SkinPoint& from, std::uint32_t guess) const;
  /// The mean optical density of an area of the scan; nothing if it has no colour.
  std::optional<Eigen::Vector3d> density_at(const ScanArea& area) const;
  /// The template's optical densities; zero if it has no texture.
  Eigen::Vector3d template_density(std::size_t picture, const Eigen::Vector2d& uv,
                                   const Eigen::Vector2d& across,
                                   const Eigen::Vector2d& down) const;
  /// Measures the scan at the vertices: sets `densities`, and returns the confidence of each.
  std::vector<double> measure_vertices(Positions& densities) const;
  void find_trust(const std::vector<double>& confidence);
  void estimate_shading(const std::vector<double>& confidence, const Positions& densities);
  /// \param differences  #skin by 3: density of the scan minus that of the template.
  void match_tone(const std::vector<double>& confidence, const Positions& differences);

  /// One texel of a picture.
  struct Texel {
    const SurfaceTexels::Triangle* triangle = nullptr;
    std::array<std::uint32_t, 3> rows = {};  ///< of the skin
    Eigen::Vector3d across, down;  ///< change of place to the texel to the right, and below
  };
  /// The colour of a texel of the skin, as optical densities, and its share that is filled.
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
